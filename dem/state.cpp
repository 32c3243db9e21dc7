#include "dem/state.hpp"

#include "dem/columns.hpp"
#include "dem/numbers/hash.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <string_view>

namespace listric::dem {

State empty_state() {
    State state;
    Table& discs = state.discs;
    discs.add(columns::id);
    discs.add(columns::x);
    discs.add(columns::y);
    discs.add(columns::vx);
    discs.add(columns::vy);
    discs.add(columns::rotation);
    discs.add(columns::spin);
    discs.add(columns::radius);
    discs.add(columns::mass);
    discs.add(columns::material);
    discs.add(columns::stratum);
    discs.add(columns::start_x);
    discs.add(columns::start_y);
    discs.add(columns::start_travel);
    discs.add(columns::searched_x);
    discs.add(columns::searched_y);

    Table& contacts = state.contacts;
    contacts.add(columns::first);
    contacts.add(columns::second);
    contacts.add(columns::shear_force);
    contacts.add(columns::bonded);
    contacts.add(columns::tensile_strength);
    contacts.add(columns::shear_strength);

    state.base_contacts.add(columns::disc);
    state.base_contacts.add(columns::surface);
    state.base_contacts.add(columns::shear_force);
    return state;
}

namespace {

template <class Columns, class AnyTable> Columns discs_of(AnyTable& t) {
    const auto entry = [&](const auto& column) {
        return t.has(column) ? t.get(column) : decltype(t.get(column))();
    };
    return {entry(columns::id),         t.get(columns::x),
            t.get(columns::y),          t.get(columns::vx),
            t.get(columns::vy),         t.get(columns::rotation),
            t.get(columns::spin),       t.get(columns::radius),
            t.get(columns::mass),       t.get(columns::material),
            entry(columns::stratum),    entry(columns::start_x),
            entry(columns::start_y),    entry(columns::start_travel),
            t.get(columns::searched_x), t.get(columns::searched_y)};
}

template <class Columns, class AnyTable> Columns contacts_of(AnyTable& t) {
    return {
        t.get(columns::first),  t.get(columns::second),           t.get(columns::shear_force),
        t.get(columns::bonded), t.get(columns::tensile_strength), t.get(columns::shear_strength)};
}

template <class Columns, class AnyTable> Columns base_contacts_of(AnyTable& t) {
    return {t.get(columns::disc), t.get(columns::surface), t.get(columns::shear_force)};
}

template <class Columns, class AnyTable> Columns base_nodes_of(AnyTable& t) {
    if (t.rows() == 0)
        return {};
    return {t.get(columns::x),          t.get(columns::y),      t.get(columns::ux),
            t.get(columns::uy),         t.get(columns::vx),     t.get(columns::vy),
            t.get(columns::load_x),     t.get(columns::load_y), t.get(columns::searched_ux),
            t.get(columns::searched_uy)};
}

} // namespace

DiscColumns disc_columns(State& s) { return discs_of<DiscColumns>(s.discs); }
ConstDiscColumns disc_columns(const State& s) { return discs_of<ConstDiscColumns>(s.discs); }
ContactColumns contact_columns(State& s) { return contacts_of<ContactColumns>(s.contacts); }
ConstContactColumns contact_columns(const State& s) {
    return contacts_of<ConstContactColumns>(s.contacts);
}
BaseContactColumns base_contact_columns(State& s) {
    return base_contacts_of<BaseContactColumns>(s.base_contacts);
}
ConstBaseContactColumns base_contact_columns(const State& s) {
    return base_contacts_of<ConstBaseContactColumns>(s.base_contacts);
}

BaseNodeColumns base_node_columns(State& s) { return base_nodes_of<BaseNodeColumns>(s.base_nodes); }
ConstBaseNodeColumns base_node_columns(const State& s) {
    return base_nodes_of<ConstBaseNodeColumns>(s.base_nodes);
}

void add_base_nodes(State& state, std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size());
    Table& nodes = state.base_nodes;
    nodes = {};
    nodes.resize(x.size());
    using namespace columns;
    for (const ColumnName<double>& column : {columns::x, columns::y, ux, uy, vx, vy})
        nodes.add(column);
    nodes.add(load_x);
    nodes.add(load_y);
    nodes.add(searched_ux);
    nodes.add(searched_uy);
    std::ranges::copy(x, nodes.get(columns::x).begin());
    std::ranges::copy(y, nodes.get(columns::y).begin());
    state.base_contacts.add(columns::place);
}

std::size_t add_discs(State& state, std::size_t count) {
    const std::size_t first = state.discs.rows();
    state.discs.resize(first + count);
    for (std::int64_t& id : state.discs.get(columns::id).subspan(first))
        id = state.next_id++;
    return first;
}

void reorder_discs(State& state, std::span<const std::int32_t> order) {
    std::vector<std::int32_t> moved_to(state.discs.rows(), -1);
    for (std::size_t k = 0; k < order.size(); ++k)
        moved_to[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
    state.discs.reorder(order);

    ContactColumns contacts = contact_columns(state);
    std::span<double> rolling;
    if (state.contacts.has(columns::rolling_moment))
        rolling = state.contacts.get(columns::rolling_moment);
    std::vector<std::int32_t> kept;
    for (std::size_t c = 0; c < contacts.first.size(); ++c) {
        std::int32_t& first = contacts.first[c];
        std::int32_t& second = contacts.second[c];
        first = moved_to[static_cast<std::size_t>(first)];
        second = moved_to[static_cast<std::size_t>(second)];
        // The shear force keeps its sign: swapping the discs turns both normal and force around.
        if (first > second) {
            std::swap(first, second);
            if (!rolling.empty())
                rolling[c] = -rolling[c];
        }
        if (first >= 0)
            kept.push_back(static_cast<std::int32_t>(c));
    }
    sort_shared(std::span(kept), [&](std::int32_t a, std::int32_t b) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        return std::pair(contacts.first[i], contacts.second[i]) <
               std::pair(contacts.first[j], contacts.second[j]);
    });
    state.contacts.reorder(kept);

    BaseContactColumns base_contacts = base_contact_columns(state);
    kept.clear();
    for (std::size_t c = 0; c < base_contacts.disc.size(); ++c) {
        std::int32_t& disc = base_contacts.disc[c];
        disc = moved_to[static_cast<std::size_t>(disc)];
        if (disc >= 0)
            kept.push_back(static_cast<std::int32_t>(c));
    }
    std::ranges::sort(kept, {}, [&](std::int32_t c) {
        const auto k = static_cast<std::size_t>(c);
        return std::pair(base_contacts.disc[k], base_contacts.surface[k]);
    });
    state.base_contacts.reorder(kept);
}

void sort_discs(State& state) {
    const DiscColumns d = disc_columns(state);
    const double strip = 3.0 * state.mean_radius;
    std::vector<std::int32_t> order(d.x.size());
    std::iota(order.begin(), order.end(), 0);
    sort_shared(std::span(order), [&](std::int32_t a, std::int32_t b) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        const double si = std::floor(d.x[i] / strip), sj = std::floor(d.x[j] / strip);
        if (si != sj)
            return si < sj;
        return d.y[i] != d.y[j] ? d.y[i] < d.y[j] : d.id[i] < d.id[j];
    });
    reorder_discs(state, order);
}

bool is_valid(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const auto is_disc = [&](std::int32_t row) {
        return row >= 0 && static_cast<std::size_t>(row) < d.x.size();
    };
    std::vector<std::int64_t> ids(d.id.begin(), d.id.end());
    std::ranges::sort(ids);
    bool valid = std::ranges::adjacent_find(ids) == ids.end() &&
                 (ids.empty() || (ids.front() >= 0 && ids.back() < state.next_id));
    for (std::size_t i = 0; i < d.x.size(); ++i)
        valid &= d.radius[i] > 0.0 && d.mass[i] > 0.0 && d.material[i] < state.materials.size();
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        valid &= is_disc(c.first[k]) && is_disc(c.second[k]) && c.first[k] < c.second[k];
        valid &= k == 0 ||
                 std::pair(c.first[k - 1], c.second[k - 1]) < std::pair(c.first[k], c.second[k]);
    }
    for (const std::int32_t disc : b.disc)
        valid &= is_disc(disc);
    return valid;
}

namespace {

void mix(std::uint64_t& h, std::uint64_t word) { h = mixed(h, word); }
void mix(std::uint64_t& h, double value) { mix(h, std::bit_cast<std::uint64_t>(value)); }
void mix(std::uint64_t& h, float value) {
    mix(h, static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value)));
}
void mix(std::uint64_t& h, std::int64_t value) { mix(h, static_cast<std::uint64_t>(value)); }
void mix(std::uint64_t& h, std::int32_t value) { mix(h, static_cast<std::int64_t>(value)); }
void mix(std::uint64_t& h, std::uint8_t value) { mix(h, static_cast<std::uint64_t>(value)); }

/// Recorded hashes keep the name that a column had before.
std::string_view hashed_name(std::string_view name) {
    return name == "start_travel" ? "start_extension" : name;
}

void mix(std::uint64_t& h, const Table& table, Notes notes) {
    mix(h, static_cast<std::uint64_t>(table.rows()));
    for (const Column& column : table.columns()) {
        if (column.is_note && notes == Notes::left_out)
            continue;
        for (char letter : hashed_name(column.name))
            mix(h, static_cast<std::uint8_t>(letter));
        std::visit(
            [&](const auto& values) {
                for (const auto& value : values)
                    mix(h, value);
            },
            column.values);
    }
}

/// Properties that only materials of layers have.
void mix_of_layer(std::uint64_t& h, const Material& m) {
    for (const std::uint8_t value :
         {static_cast<std::uint8_t>(m.is_soft), static_cast<std::uint8_t>(m.is_welded), m.weak_of,
          static_cast<std::uint8_t>(m.bonds.has_value())})
        mix(h, value);
    const BondStrength b = m.bonds.value_or(BondStrength{});
    for (const double value :
         {b.tensile_mean, b.tensile_deviation, b.shear_mean, b.shear_deviation})
        mix(h, value);
    mix(h, static_cast<std::uint8_t>(b.reading));
}

} // namespace

std::uint64_t hash(const Table& table) {
    std::uint64_t h = 0x7461626c65u;
    mix(h, table, Notes::counted);
    return h;
}

std::uint64_t hash(const State& state, Notes notes) {
    std::uint64_t h = 0x4c697374726963u;
    mix(h, state.discs, notes);
    mix(h, state.contacts, notes);
    mix(h, state.base_contacts, notes);
    if (state.base_nodes.rows() > 0)
        mix(h, state.base_nodes, notes);
    for (const auto& [name, table] : state.base_memory)
        mix(h, table, notes);
    for (std::size_t k = 0; k < state.materials.size(); ++k) {
        const Material& m = state.materials[k];
        mix(h, m.normal_stiffness);
        mix(h, m.shear_stiffness);
        mix(h, m.friction);
        mix(h, static_cast<std::uint8_t>(m.bondable));
        if (m.rolling_friction != 0.0) // recorded hashes have none
            mix(h, m.rolling_friction);
        if (k > weak)
            mix_of_layer(h, m);
    }
    mix(h, state.clock.cycle);
    for (double value :
         {state.clock.time_step, state.clock.travel.m, state.ledger.initial, state.ledger.deposited,
          state.ledger.removed, state.mean_radius, state.inertial_mass_floor, state.skin,
          state.searched_extension, state.displacement_bound, state.window_speed})
        mix(h, value);
    mix(h, state.check_interval);
    mix(h, state.seed);
    mix(h, state.next_id);
    return h;
}

} // namespace listric::dem
