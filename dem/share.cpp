#include "dem/share.hpp"

#include "dem/bytes.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>
#include <variant>

namespace listric::dem {

namespace {

/// Whether cycles need a column of discs: a core column, or one that damping or compaction adds.
/// What effects remember stays with the whole.
bool is_for_cycles(const std::string& name) {
    static const State core = empty_state();
    return core.discs.has(name) || name == "mean_vx" || name == "mean_vy" ||
           name == "radius_rate" || name == "inertial_radius";
}

/// The rows of a table that are asked for, of columns for which is_wanted(name) holds.
template <class Wanted>
Table selected(const Table& table, std::span<const std::int32_t> rows, Wanted&& is_wanted) {
    Table result;
    for (const Column& column : table.columns()) {
        if (!is_wanted(column.name))
            continue;
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

/// Of what the cycle writes.
constexpr const char* disc_names[] = {"x",    "y",      "vx",      "vy",     "rotation",
                                      "spin", "radius", "mean_vx", "mean_vy"};
constexpr const char* contact_names[] = {"shear_force", "bonded"};
constexpr const char* base_contact_names[] = {"shear_force", "place"};

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

Cut::Cut(const State& whole, std::vector<std::int32_t> rank, int count)
    : whole_(whole), rank_(std::move(rank)), lists_(static_cast<std::size_t>(count)),
      local_(rank_.size(), -1) {
    assert(rank_.size() == whole.discs.rows());
    const ConstContactColumns c = contact_columns(whole);
    const ConstBaseContactColumns b = base_contact_columns(whole);
    for (std::size_t i = 0; i < rank_.size(); ++i)
        lists_of(i).own.push_back(static_cast<std::int32_t>(i));
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto first = static_cast<std::size_t>(c.first[k]);
        const auto second = static_cast<std::size_t>(c.second[k]);
        lists_of(first).contacts.push_back(static_cast<std::int32_t>(k));
        if (rank_[first] == rank_[second])
            continue;
        lists_of(second).contacts.push_back(static_cast<std::int32_t>(k));
        lists_of(first).ghosts.push_back(c.second[k]);
        lists_of(second).ghosts.push_back(c.first[k]);
    }
    for (std::size_t k = 0; k < b.disc.size(); ++k)
        lists_of(static_cast<std::size_t>(b.disc[k]))
            .base_contacts.push_back(static_cast<std::int32_t>(k));
    for (Lists& lists : lists_) {
        std::ranges::sort(lists.ghosts);
        lists.ghosts.erase(std::ranges::unique(lists.ghosts).begin(), lists.ghosts.end());
    }
}

Cut::Lists& Cut::lists_of(std::size_t disc) {
    return lists_[static_cast<std::size_t>(rank_[disc])];
}

Share Cut::share(int of) {
    const Lists& mine = lists_[static_cast<std::size_t>(of)];
    Share share;
    share.rows.resize(mine.own.size() + mine.ghosts.size());
    std::ranges::merge(mine.own, mine.ghosts, share.rows.begin());
    share.contacts = mine.contacts;
    share.base_contacts = mine.base_contacts;
    share.sent.resize(lists_.size());
    share.received.resize(lists_.size());
    for (std::size_t k = 0; k < share.rows.size(); ++k) {
        const auto row = static_cast<std::size_t>(share.rows[k]);
        local_[row] = static_cast<std::int32_t>(k);
        share.own.push_back(rank_[row] == of);
        if (rank_[row] != of)
            share.received[static_cast<std::size_t>(rank_[row])].push_back(local_[row]);
    }
    for (std::size_t other = 0; other < lists_.size(); ++other)
        for (const std::int32_t row : lists_[other].ghosts)
            if (rank_[static_cast<std::size_t>(row)] == of)
                share.sent[other].push_back(local_[static_cast<std::size_t>(row)]);

    State& part = share.state;
    const auto any = [](const std::string&) { return true; };
    part.discs = selected(whole_.discs, share.rows, is_for_cycles);
    part.contacts = selected(whole_.contacts, share.contacts, any);
    part.base_contacts = selected(whole_.base_contacts, share.base_contacts, any);
    part.base_nodes = whole_.base_nodes;
    if (of != 0) // the root's have the loads of all
        for (const auto loads : {base_node_columns(part).load_x, base_node_columns(part).load_y})
            std::ranges::fill(loads, 0);
    part.materials = whole_.materials;
    part.clock = whole_.clock;
    part.ledger = whole_.ledger;
    part.seed = whole_.seed;
    part.next_id = whole_.next_id;
    part.mean_radius = whole_.mean_radius;
    part.inertial_mass_floor = whole_.inertial_mass_floor;
    part.skin = whole_.skin;
    part.searched_extension = whole_.searched_extension;
    part.displacement_bound = whole_.displacement_bound;
    part.window_speed = whole_.window_speed;
    part.look_interval = whole_.look_interval;
    const auto renumber = [&](std::span<std::int32_t> discs) {
        for (std::int32_t& disc : discs)
            disc = local_[static_cast<std::size_t>(disc)];
    };
    renumber(contact_columns(part).first);
    renumber(contact_columns(part).second);
    renumber(base_contact_columns(part).disc);
    return share;
}

OwnRows own_rows(const Share& share) {
    OwnRows own;
    for (std::size_t k = 0; k < share.rows.size(); ++k)
        if (share.own[k])
            own.discs.push_back(share.rows[k]);
    const auto first = contact_columns(share.state).first;
    for (std::size_t k = 0; k < share.contacts.size(); ++k)
        if (share.own[static_cast<std::size_t>(first[k])])
            own.contacts.push_back(share.contacts[k]);
    own.base_contacts = share.base_contacts;
    return own;
}

namespace {

/// Values of the columns of these names in the rows for which is_wanted(row) holds.
template <class Wanted>
void add_values(const Table& table, std::span<const char* const> names, Wanted&& is_wanted,
                BytesOut& to) {
    for (const char* name : names) {
        const auto column = std::ranges::find(table.columns(), name, &Column::name);
        if (column == table.columns().end())
            continue;
        std::visit(
            [&]<class T>(const std::vector<T>& values) {
                std::vector<T> wanted;
                for (std::size_t k = 0; k < values.size(); ++k)
                    if (is_wanted(k))
                        wanted.push_back(values[k]);
                to.add(wanted);
            },
            column->values);
    }
}

void take_values(BytesIn& from, std::span<const char* const> names,
                 std::span<const std::int32_t> rows, Table& table) {
    for (const char* name : names) {
        const auto column = std::ranges::find(table.columns(), name, &Column::name);
        if (column == table.columns().end())
            continue;
        std::visit(
            [&]<class T>(const std::vector<T>&) {
                const std::vector<T> values = from.take_all<T>();
                const auto to = table.get<T>(name);
                assert(values.size() == rows.size());
                for (std::size_t k = 0; k < rows.size(); ++k)
                    to[static_cast<std::size_t>(rows[k])] = values[k];
            },
            column->values);
    }
}

/// What every rank knows.
struct Known {
    Clock clock;
    double displacement_bound, window_speed;
    std::int64_t look_interval;
};

void add_table(const Table& table, BytesOut& to) {
    to.add(table.columns().size());
    for (const Column& column : table.columns()) {
        to.add(std::string_view(column.name));
        to.add(std::string_view(column.unit));
        to.add(std::string_view(column.begins_as));
        to.add(column.values.index());
        std::visit([&](const auto& values) { to.add(values); }, column.values);
        std::visit([&](const auto& initial) { to.add(initial); }, column.initial);
    }
}

template <std::size_t index = 0> void take_values(BytesIn& from, std::size_t wanted, Column& to) {
    if constexpr (index < std::variant_size_v<Column::Values>) {
        if (index != wanted)
            return take_values<index + 1>(from, wanted, to);
        using T = typename std::variant_alternative_t<index, Column::Values>::value_type;
        to.values = from.take_all<T>();
        to.initial = from.take<T>();
    }
}

Table take_table(BytesIn& from) {
    Table table;
    for (auto columns = from.take<std::size_t>(); columns > 0; --columns) {
        Column column;
        column.name = from.take_text();
        column.unit = from.take_text();
        column.begins_as = from.take_text();
        take_values(from, from.take<std::size_t>(), column);
        table.set(std::move(column));
    }
    return table;
}

/// Adds the loads on the nodes of a base to others of the same nodes.
void add_loads(const Table& nodes, Table& to) {
    for (const char* name : {"load_x", "load_y"})
        if (to.has(name))
            std::ranges::transform(nodes.get<std::int64_t>(name), to.get<std::int64_t>(name),
                                   to.get<std::int64_t>(name).begin(), std::plus());
}

} // namespace

Bytes changes(const Share& share) {
    const State& state = share.state;
    BytesOut to;
    to.add(Known{state.clock, state.displacement_bound, state.window_speed, state.look_interval});
    add_values(
        state.discs, disc_names, [&](std::size_t k) { return share.own[k] != 0; }, to);
    // Both ranks of a contact have it; that of the first disc is asked.
    const auto first = contact_columns(state).first;
    add_values(
        state.contacts, contact_names,
        [&](std::size_t k) { return share.own[static_cast<std::size_t>(first[k])] != 0; }, to);
    add_values(
        state.base_contacts, base_contact_names, [](std::size_t) { return true; }, to);
    add_table(state.base_nodes, to);
    return to.take();
}

void put_back(const Bytes& changes, int rank, const OwnRows& rows, State& whole) {
    BytesIn from(changes);
    const auto known = from.take<Known>();
    whole.clock = known.clock;
    whole.displacement_bound = known.displacement_bound;
    whole.window_speed = known.window_speed;
    whole.look_interval = known.look_interval;
    take_values(from, disc_names, rows.discs, whole.discs);
    take_values(from, contact_names, rows.contacts, whole.contacts);
    take_values(from, base_contact_names, rows.base_contacts, whole.base_contacts);
    Table nodes = take_table(from);
    if (rank != 0)
        add_loads(whole.base_nodes, nodes);
    whole.base_nodes = std::move(nodes);
}

Bytes packed(const Share& share) {
    const State& state = share.state;
    BytesOut to;
    for (const Table* table :
         {&state.discs, &state.contacts, &state.base_contacts, &state.base_nodes})
        add_table(*table, to);
    to.add(state.materials);
    to.add(Known{state.clock, state.displacement_bound, state.window_speed, state.look_interval});
    for (const double number :
         {state.mean_radius, state.inertial_mass_floor, state.skin, state.searched_extension})
        to.add(number);
    for (const auto* rows : {&share.rows, &share.contacts, &share.base_contacts})
        to.add(*rows);
    to.add(share.own);
    to.add(share.sent.size());
    for (const auto* by_rank : {&share.sent, &share.received})
        for (const auto& rows : *by_rank)
            to.add(rows);
    return to.take();
}

Share unpacked(const Bytes& bytes) {
    BytesIn from(bytes);
    Share share;
    State& state = share.state;
    for (Table* table : {&state.discs, &state.contacts, &state.base_contacts, &state.base_nodes})
        *table = take_table(from);
    state.materials = from.take_all<Material>();
    const auto known = from.take<Known>();
    state.clock = known.clock;
    state.displacement_bound = known.displacement_bound;
    state.window_speed = known.window_speed;
    state.look_interval = known.look_interval;
    for (double* number :
         {&state.mean_radius, &state.inertial_mass_floor, &state.skin, &state.searched_extension})
        *number = from.take<double>();
    for (auto* rows : {&share.rows, &share.contacts, &share.base_contacts})
        *rows = from.take_all<std::int32_t>();
    share.own = from.take_all<std::uint8_t>();
    const auto count = from.take<std::size_t>();
    for (auto* by_rank : {&share.sent, &share.received})
        for (std::size_t k = 0; k < count; ++k)
            by_rank->push_back(from.take_all<std::int32_t>());
    return share;
}

} // namespace listric::dem
