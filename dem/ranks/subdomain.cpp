#include "dem/ranks/subdomain.hpp"

#include "dem/columns.hpp"
#include "dem/cycle/cycle_work.hpp"
#include "dem/ranks/table_bytes.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <utility>
#include <variant>

namespace listric::dem {

namespace {

/// Whether cycles need a column of discs: of the core columns, or one that damping, compaction or
/// pushes add. What discs and effects remember stays with the whole.
bool is_for_cycles(std::string_view name) {
    using namespace columns;
    constexpr std::string_view names[] = {
        x,        y,          vx,         vy,      rotation, spin,        radius,          mass,
        material, searched_x, searched_y, mean_vx, mean_vy,  radius_rate, inertial_radius, push_x,
        push_y};
    return std::ranges::find(names, name) != std::end(names);
}

/// Whether cycles, or updates of neighbour lists, change a column of discs.
bool is_changed(std::string_view name) {
    using namespace columns;
    constexpr std::string_view names[] = {x,      y,       vx,      vy,         rotation,  spin,
                                          radius, mean_vx, mean_vy, searched_x, searched_y};
    return std::ranges::find(names, name) != std::end(names);
}

} // namespace

std::vector<std::int32_t> ranks_by_rows(const State& state, int count) {
    assert(count > 0);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    std::vector<std::int64_t> work(state.discs.rows(), disc_work);
    for (const std::int32_t first : c.first)
        work[static_cast<std::size_t>(first)] += contact_work;
    for (const std::int32_t disc : b.disc)
        work[static_cast<std::size_t>(disc)] += base_contact_work;
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
        lists.ghosts.erase(std::unique(lists.ghosts.begin(), lists.ghosts.end()),
                           lists.ghosts.end());
    }
}

Cut::Lists& Cut::lists_of(std::size_t disc) {
    return lists_[static_cast<std::size_t>(rank_[disc])];
}

Subdomain Cut::subdomain(int of) {
    const Lists& mine = lists_[static_cast<std::size_t>(of)];
    Subdomain subdomain;
    subdomain.rows.resize(mine.own.size() + mine.ghosts.size());
    std::ranges::merge(mine.own, mine.ghosts, subdomain.rows.begin());
    subdomain.sent.resize(lists_.size());
    subdomain.received.resize(lists_.size());
    for (std::size_t k = 0; k < subdomain.rows.size(); ++k) {
        const auto row = static_cast<std::size_t>(subdomain.rows[k]);
        local_[row] = static_cast<std::int32_t>(k);
        subdomain.own.push_back(rank_[row] == of);
        if (rank_[row] != of)
            subdomain.received[static_cast<std::size_t>(rank_[row])].push_back(local_[row]);
    }
    for (std::size_t other = 0; other < lists_.size(); ++other)
        for (const std::int32_t row : lists_[other].ghosts)
            if (rank_[static_cast<std::size_t>(row)] == of)
                subdomain.sent[other].push_back(local_[static_cast<std::size_t>(row)]);

    State& part = subdomain.state;
    part.discs = selected(whole_.discs, subdomain.rows, is_for_cycles);
    part.contacts = selected(whole_.contacts, mine.contacts);
    part.base_contacts = selected(whole_.base_contacts, mine.base_contacts);
    part.base_nodes = whole_.base_nodes;
    if (of != 0) // the root's have the loads of all
        for (const auto loads : {base_node_columns(part).load_x, base_node_columns(part).load_y})
            std::ranges::fill(loads, 0);
    part.materials = whole_.materials;
    const StateNumbers& numbers = whole_;
    static_cast<StateNumbers&>(part) = numbers;
    const auto renumber = [&](std::span<std::int32_t> discs) {
        for (std::int32_t& disc : discs)
            disc = local_[static_cast<std::size_t>(disc)];
    };
    renumber(contact_columns(part).first);
    renumber(contact_columns(part).second);
    renumber(base_contact_columns(part).disc);
    return subdomain;
}

namespace {

/// Adds the loads on the nodes of a base to others of the same nodes.
void add_loads(const Table& nodes, Table& to) {
    for (const auto& load : {columns::load_x, columns::load_y})
        if (to.has(load))
            std::ranges::transform(nodes.get(load), to.get(load), to.get(load).begin(),
                                   std::plus());
}

/// Rows for which is_wanted(row) holds.
template <class Wanted> std::vector<std::int32_t> rows_where(std::size_t rows, Wanted&& is_wanted) {
    std::vector<std::int32_t> wanted;
    for (std::size_t k = 0; k < rows; ++k)
        if (is_wanted(k))
            wanted.push_back(static_cast<std::int32_t>(k));
    return wanted;
}

/// Adds those rows of a table of pairs, with the discs' rows in the whole.
void add_pairs(const Table& table, std::span<const std::int32_t> rows,
               std::initializer_list<ColumnName<std::int32_t>> discs, const Subdomain& subdomain,
               BytesOut& to) {
    Table pairs = selected(table, rows);
    for (const ColumnName<std::int32_t>& name : discs)
        for (std::int32_t& disc : pairs.get(name))
            disc = subdomain.rows[static_cast<std::size_t>(disc)];
    add_table(pairs, to);
}

void put_values(const Table& from, std::span<const std::int32_t> rows, Table& to) {
    for (const Column& column : from.columns())
        std::visit(
            [&]<class T>(const std::vector<T>& values) {
                const auto all = to.get<T>(column.name);
                for (std::size_t k = 0; k < rows.size(); ++k)
                    all[static_cast<std::size_t>(rows[k])] = values[k];
            },
            column.values);
}

/// In the order of pairs, if they are not.
void sort_pairs(Table& table, const ColumnName<std::int32_t>& first_name,
                const ColumnName<std::int32_t>& second_name) {
    const auto first = table.get(first_name);
    const auto second = table.get(second_name);
    const auto pair_of = [&](std::int32_t row) {
        return std::pair(first[static_cast<std::size_t>(row)],
                         second[static_cast<std::size_t>(row)]);
    };
    std::vector<std::int32_t> order = rows_where(first.size(), [](std::size_t) { return true; });
    if (std::ranges::is_sorted(order, {}, pair_of))
        return;
    std::ranges::sort(order, {}, pair_of);
    table.reorder(order);
}

/// Room for a subdomain as bytes: messages that grow would need it twice.
std::size_t most_bytes(const Subdomain& subdomain) {
    std::size_t bytes = 4096 + subdomain.rows.size() * 16;
    for (const Table* table : {&subdomain.state.discs, &subdomain.state.contacts,
                               &subdomain.state.base_contacts, &subdomain.state.base_nodes})
        bytes += byte_count(*table);
    return bytes;
}

} // namespace

Bytes changes(const Subdomain& subdomain) {
    const State& state = subdomain.state;
    BytesOut to;
    to.reserve(most_bytes(subdomain));
    to.add<StateNumbers>(state);
    const auto own =
        rows_where(subdomain.rows.size(), [&](std::size_t k) { return subdomain.own[k]; });
    add_table(selected(state.discs, own, is_changed), to);
    // Both ranks of a contact have it; that of the first disc is asked.
    const auto first = contact_columns(state).first;
    add_pairs(state.contacts,
              rows_where(
                  first.size(),
                  [&](std::size_t k) { return subdomain.own[static_cast<std::size_t>(first[k])]; }),
              {columns::first, columns::second}, subdomain, to);
    add_pairs(state.base_contacts,
              rows_where(state.base_contacts.rows(), [](std::size_t) { return true; }),
              {columns::disc}, subdomain, to);
    add_table(state.base_nodes, to);
    return to.take();
}

void put_back(const Bytes& changes, int rank, std::span<const std::int32_t> own, State& whole) {
    BytesIn from(changes);
    static_cast<StateNumbers&>(whole) = from.take<StateNumbers>();
    put_values(take_table(from), own, whole.discs);
    for (Table* pairs : {&whole.contacts, &whole.base_contacts}) {
        if (rank == 0)
            *pairs = take_table(from);
        else
            append_rows(take_table(from), *pairs);
    }
    Table nodes = take_table(from);
    if (rank != 0)
        add_loads(whole.base_nodes, nodes);
    whole.base_nodes = std::move(nodes);
}

void sort_contacts(State& whole) {
    sort_pairs(whole.contacts, columns::first, columns::second);
    sort_pairs(whole.base_contacts, columns::disc, columns::surface);
}

Bytes packed(const Subdomain& subdomain) {
    const State& state = subdomain.state;
    BytesOut to;
    to.reserve(most_bytes(subdomain));
    for (const Table* table :
         {&state.discs, &state.contacts, &state.base_contacts, &state.base_nodes})
        add_table(*table, to);
    to.add(state.materials);
    to.add<StateNumbers>(state);
    to.add(subdomain.rows);
    to.add(subdomain.own);
    to.add(subdomain.sent.size());
    for (const auto* by_rank : {&subdomain.sent, &subdomain.received})
        for (const auto& rows : *by_rank)
            to.add(rows);
    return to.take();
}

Subdomain unpacked(const Bytes& bytes) {
    BytesIn from(bytes);
    Subdomain subdomain;
    State& state = subdomain.state;
    for (Table* table : {&state.discs, &state.contacts, &state.base_contacts, &state.base_nodes})
        *table = take_table(from);
    state.materials = from.take_all<Material>();
    static_cast<StateNumbers&>(state) = from.take<StateNumbers>();
    subdomain.rows = from.take_all<std::int32_t>();
    subdomain.own = from.take_all<std::uint8_t>();
    const auto count = from.take<std::size_t>();
    for (auto* by_rank : {&subdomain.sent, &subdomain.received})
        for (std::size_t k = 0; k < count; ++k)
            by_rank->push_back(from.take_all<std::int32_t>());
    return subdomain;
}

} // namespace listric::dem
