#pragma once

#include "dem/clocks.hpp"
#include "dem/column.hpp"
#include "dem/material.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace listric::dem {

/// Where the simulation is. Geological time is travel over the rate of extension.
struct Clock {
    std::int64_t cycle = 0; ///< cycles since extension began
    double time_step = 0.0; ///< s
    Travel travel;          ///< the clock of all events, see Motion
    Extension extension;    ///< Motion::position(travel)

    double time() const { return static_cast<double>(cycle) * time_step; } ///< s
};

/// Mass that entered or left the model, kg per metre of thickness.
struct Ledger {
    double initial = 0.0;
    double deposited = 0.0;
    double removed = 0.0;
};

/// The scalar part of a State.
struct StateNumbers {
    Clock clock;
    Ledger ledger;
    std::uint64_t seed = 1;
    std::int64_t next_id = 0;         ///< ids grow and are never used again
    double mean_radius = 0.0;         ///< of the basement, m: the model's resolution
    double inertial_mass_floor = 0.0; ///< discs lighter than this move as if they had it, kg
    double skin = 0.0;                ///< margin of the neighbour list, m
    double searched_extension = 0.0;  ///< where the last search of all surfaces found them, m
    /// No disc or surface is further from where it was found, m; none has been looked for yet.
    double displacement_bound = std::numeric_limits<double>::infinity();
    double window_speed = 0.0;       ///< greatest since that bound was last checked, m/s
    std::int64_t check_interval = 1; ///< cycles between checks of it, at multiples
};

/// All that the next cycle depends on: copy it, hash it, save it.
struct State : StateNumbers {
    Table discs;         ///< see DiscColumns
    Table contacts;      ///< see ContactColumns
    Table base_contacts; ///< see BaseContactColumns
    Table base_nodes;    ///< see BaseNodeColumns; empty where the base is rigid
    std::map<std::string, Table> base_memory; ///< of what answers to the nodes' loads, by name
    std::vector<Material> materials;          ///< by MaterialIndex
};

/// Columns that every disc has. (1): cycles do not need it, so a Subdomain has none, an empty span.
template <bool writable> struct BasicDiscColumns {
    template <class T> using Values = std::span<std::conditional_t<writable, T, const T>>;

    Values<std::int64_t> id;               ///< (1)
    Values<double> x, y;                   ///< centre, m; y up from the original surface
    Values<double> vx, vy;                 ///< m/s
    Values<double> rotation, spin;         ///< rad, rad/s; counter-clockwise
    Values<double> radius;                 ///< m
    Values<double> mass;                   ///< kg per metre of thickness
    Values<std::uint8_t> material;         ///< MaterialIndex
    Values<std::int32_t> stratum;          ///< 0 before the rift, n for the n-th sedimentation (1)
    Values<double> start_x, start_y;       ///< where the disc entered the model, m (1)
    Values<double> start_travel;           ///< and when, m of travel (1)
    Values<double> searched_x, searched_y; ///< where the last neighbour search found it, m
};

/// Columns of every pair of discs that are closer than the skin, sorted by (first, second).
template <bool writable> struct BasicContactColumns {
    template <class T> using Values = std::span<std::conditional_t<writable, T, const T>>;

    Values<std::int32_t> first, second; ///< rows of the disc table, first < second
    Values<double> shear_force;         ///< N, on `second` along (-n_y, n_x)
    Values<std::uint8_t> bonded;
    Values<float> tensile_strength, shear_strength; ///< of the bond, N
};

/// Columns of every disc and surface of the base that are closer than the skin.
template <bool writable> struct BasicBaseContactColumns {
    template <class T> using Values = std::span<std::conditional_t<writable, T, const T>>;

    Values<std::int32_t> disc, surface; ///< row of the disc table; index of the surface
    Values<double> shear_force;         ///< N, on the disc along (-n_y, n_x)
};

/// Columns of every node of a base that deforms, from the breakaway down. Contacts of such a base
/// have a column `place` on top, TracePoint::place.
template <bool writable> struct BasicBaseNodeColumns {
    template <class T> using Values = std::span<std::conditional_t<writable, T, const T>>;

    Values<double> x, y;                     ///< without load, m
    Values<double> ux, uy;                   ///< displacement, m
    Values<double> vx, vy;                   ///< m/s
    Values<std::int64_t> load_x, load_y;     ///< of the discs, summed over cycles, load_unit
    Values<double> searched_ux, searched_uy; ///< at the last search of all surfaces, m
};

using DiscColumns = BasicDiscColumns<true>;
using ContactColumns = BasicContactColumns<true>;
using BaseContactColumns = BasicBaseContactColumns<true>;
using ConstDiscColumns = BasicDiscColumns<false>;
using ConstContactColumns = BasicContactColumns<false>;
using ConstBaseContactColumns = BasicBaseContactColumns<false>;
using BaseNodeColumns = BasicBaseNodeColumns<true>;
using ConstBaseNodeColumns = BasicBaseNodeColumns<false>;

// The spans of all of these live as long as their tables' spans: of discs until add_discs,
// reorder_discs or sort_discs; of contacts until neighbours are searched, if that comes first.

/// A state without discs but with all core columns.
State empty_state();

DiscColumns disc_columns(State& state);
ContactColumns contact_columns(State& state);
BaseContactColumns base_contact_columns(State& state);
ConstDiscColumns disc_columns(const State& state);
ConstContactColumns contact_columns(const State& state);
ConstBaseContactColumns base_contact_columns(const State& state);
BaseNodeColumns base_node_columns(State& state); ///< spans are empty where there are no nodes
ConstBaseNodeColumns base_node_columns(const State& state);

/// Gives a state the nodes of a base that deforms, at rest and without displacement.
void add_base_nodes(State& state, std::span<const double> x, std::span<const double> y);

/// Adds `count` discs with fresh ids, everything else at its initial value. Returns the first row.
std::size_t add_discs(State& state, std::size_t count);

/// Keeps the discs of `order` in that order; contacts follow, a dropped disc's contacts vanish.
void reorder_discs(State& state, std::span<const std::int32_t> order);

/// Sorts discs into vertical strips, so that discs near each other are near in memory: a strip
/// runs along the short side of the hanging wall and neighbours are at most two strips away.
void sort_discs(State& state);

/// Checks: ids are unique, contacts are sorted and their discs exist, discs have a size, a mass
/// and a material. For assertions: it takes as long as a few cycles.
bool is_valid(const State& state);

/// Hash of every name, type and value of a table.
std::uint64_t hash(const Table& table);

/// Whether a hash counts columns that are notes.
enum class Notes { left_out, counted };

/// Hash of every column and number of the state; of notes where they are counted.
std::uint64_t hash(const State& state, Notes notes = Notes::left_out);

} // namespace listric::dem
