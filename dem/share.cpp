#include "dem/share.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace listric::dem {

namespace {

/// A table of these rows.
Table selected(const Table& table, std::span<const std::int32_t> rows) {
    Table result;
    for (const Column& column : table.columns()) {
        Column part{column.name, column.unit, {}, column.initial, column.begins_as};
        std::visit(
            [&](const auto& values) {
                std::decay_t<decltype(values)> chosen;
                chosen.reserve(rows.size());
                for (const std::int32_t row : rows)
                    chosen.push_back(values[static_cast<std::size_t>(row)]);
                part.values = std::move(chosen);
            },
            column.values);
        result.set(std::move(part));
    }
    return result;
}

/// Copies the rows for which is_wanted(row of the part) of a part's columns into the whole's.
template <class Wanted>
void copy_rows(const Table& part, std::span<const std::int32_t> rows, Table& whole,
               std::span<const char* const> names, Wanted&& is_wanted) {
    for (const char* name : names) {
        if (!part.has(name))
            continue;
        const auto found = std::ranges::find(part.columns(), name, &Column::name);
        std::visit(
            [&]<class T>(const std::vector<T>& from) {
                const auto to = whole.get<T>(name);
                for (std::size_t k = 0; k < rows.size(); ++k)
                    if (is_wanted(k))
                        to[static_cast<std::size_t>(rows[k])] = from[k];
            },
            found->values);
    }
}

/// Of what the cycle writes.
constexpr const char* disc_names[] = {"x",    "y",      "vx",      "vy",     "rotation",
                                      "spin", "radius", "mean_vx", "mean_vy"};
constexpr const char* contact_names[] = {"shear_force", "bonded"};
constexpr const char* base_contact_names[] = {"shear_force", "place"};

/// By rank, the rows of the whole that a rank holds: its own discs and those they are listed with.
std::vector<std::vector<std::int32_t>>
rows_of_ranks(const State& state, std::span<const std::int32_t> rank, int count) {
    const ConstContactColumns c = contact_columns(state);
    std::vector<std::vector<std::int32_t>> rows(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < rank.size(); ++i)
        rows[static_cast<std::size_t>(rank[i])].push_back(static_cast<std::int32_t>(i));
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto a = static_cast<std::size_t>(rank[static_cast<std::size_t>(c.first[k])]);
        const auto b = static_cast<std::size_t>(rank[static_cast<std::size_t>(c.second[k])]);
        if (a == b)
            continue;
        rows[a].push_back(c.second[k]);
        rows[b].push_back(c.first[k]);
    }
    for (auto& of_rank : rows) {
        std::ranges::sort(of_rank);
        of_rank.erase(std::ranges::unique(of_rank).begin(), of_rank.end());
    }
    return rows;
}

/// The discs and contacts of one rank; its ghosts are not yet known to others.
Share share_of(const State& state, std::span<const std::int32_t> rank, std::int32_t mine,
               std::vector<std::int32_t> rows) {
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const auto is_own = [&](std::int32_t row) {
        return rank[static_cast<std::size_t>(row)] == mine;
    };
    Share share;
    share.rows = std::move(rows);
    std::vector<std::int32_t> local(rank.size(), -1);
    for (std::size_t k = 0; k < share.rows.size(); ++k) {
        local[static_cast<std::size_t>(share.rows[k])] = static_cast<std::int32_t>(k);
        share.own.push_back(is_own(share.rows[k]));
    }
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (is_own(c.first[k]) || is_own(c.second[k]))
            share.contacts.push_back(static_cast<std::int32_t>(k));
    for (std::size_t k = 0; k < b.disc.size(); ++k)
        if (is_own(b.disc[k]))
            share.base_contacts.push_back(static_cast<std::int32_t>(k));

    State& part = share.state;
    part.discs = selected(state.discs, share.rows);
    part.contacts = selected(state.contacts, share.contacts);
    part.base_contacts = selected(state.base_contacts, share.base_contacts);
    part.base_nodes = state.base_nodes;
    part.materials = state.materials;
    part.clock = state.clock;
    part.seed = state.seed;
    part.next_id = state.next_id;
    part.mean_radius = state.mean_radius;
    part.inertial_mass_floor = state.inertial_mass_floor;
    part.skin = state.skin;
    part.searched_extension = state.searched_extension;
    part.displacement_bound = state.displacement_bound;
    part.window_speed = state.window_speed;
    part.look_interval = state.look_interval;
    const auto renumber = [&](std::span<std::int32_t> discs) {
        for (std::int32_t& disc : discs)
            disc = local[static_cast<std::size_t>(disc)];
    };
    renumber(contact_columns(part).first);
    renumber(contact_columns(part).second);
    renumber(base_contact_columns(part).disc);
    return share;
}

} // namespace

std::vector<std::int32_t> ranks_by_rows(const State& state, int count) {
    assert(count > 0);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    // A contact takes about as long as a disc, a base contact as five.
    std::vector<std::int64_t> work(state.discs.rows(), 1);
    for (const std::int32_t first : c.first)
        ++work[static_cast<std::size_t>(first)];
    for (const std::int32_t disc : b.disc)
        work[static_cast<std::size_t>(disc)] += 5;
    std::int64_t all = 0;
    for (const std::int64_t w : work)
        all += w;
    std::vector<std::int32_t> rank(work.size());
    std::int64_t before = 0;
    for (std::size_t i = 0; i < work.size(); ++i) {
        rank[i] = static_cast<std::int32_t>(before * count / all);
        before += work[i];
    }
    return rank;
}

std::vector<Share> cut(const State& state, std::span<const std::int32_t> rank, int count) {
    assert(rank.size() == state.discs.rows());
    auto rows = rows_of_ranks(state, rank, count);
    std::vector<Share> shares;
    for (int r = 0; r < count; ++r) {
        shares.push_back(share_of(state, rank, r, std::move(rows[static_cast<std::size_t>(r)])));
        shares.back().sent.resize(static_cast<std::size_t>(count));
        shares.back().received.resize(static_cast<std::size_t>(count));
    }
    for (std::size_t r = 0; r < shares.size(); ++r) {
        Share& share = shares[r];
        for (std::size_t k = 0; k < share.rows.size(); ++k) {
            if (share.own[k])
                continue;
            const auto owner =
                static_cast<std::size_t>(rank[static_cast<std::size_t>(share.rows[k])]);
            const auto there = std::ranges::lower_bound(shares[owner].rows, share.rows[k]);
            share.received[owner].push_back(static_cast<std::int32_t>(k));
            shares[owner].sent[r].push_back(
                static_cast<std::int32_t>(there - shares[owner].rows.begin()));
        }
    }
    return shares;
}

void put_back(const Share& share, State& whole) {
    copy_rows(share.state.discs, share.rows, whole.discs, disc_names,
              [&](std::size_t k) { return share.own[k] != 0; });
    // Both ranks of a contact have it; that of the first disc is asked.
    const auto first = contact_columns(share.state).first;
    copy_rows(share.state.contacts, share.contacts, whole.contacts, contact_names,
              [&](std::size_t k) { return share.own[static_cast<std::size_t>(first[k])] != 0; });
    copy_rows(share.state.base_contacts, share.base_contacts, whole.base_contacts,
              base_contact_names, [](std::size_t) { return true; });
}

void read_ghosts(const State& state, std::span<const std::int32_t> from,
                 std::span<double> numbers) {
    assert(numbers.size() == ghost_numbers * from.size());
    const ConstDiscColumns d = disc_columns(state);
    double* to = numbers.data();
    for (const std::int32_t row : from) {
        const auto i = static_cast<std::size_t>(row);
        for (const double number : {d.x[i], d.y[i], d.vx[i], d.vy[i], d.spin[i]})
            *to++ = number;
    }
}

void write_ghosts(std::span<const double> numbers, std::span<const std::int32_t> to, State& state) {
    assert(numbers.size() == ghost_numbers * to.size());
    const DiscColumns d = disc_columns(state);
    const double* from = numbers.data();
    for (const std::int32_t row : to) {
        const auto i = static_cast<std::size_t>(row);
        for (double* const number : {&d.x[i], &d.y[i], &d.vx[i], &d.vy[i], &d.spin[i]})
            *number = *from++;
    }
}

} // namespace listric::dem
