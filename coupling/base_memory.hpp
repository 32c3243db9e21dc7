#pragma once

#include "dem/numbers/point.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace listric::coupling {

// Memory of an elastic base, State::base_memory: this header has the name and the columns
// of each of its tables, interface_loads.hpp of those of the effects' loads. Snapshots hold the
// names.

/// Table "modes": a row per mode.
struct ModeColumns {
    std::span<double> displacement; ///< m
    std::span<double> velocity;     ///< m/s
};
void add_mode_columns(dem::State& state, std::size_t modes);
ModeColumns mode_columns(dem::State& state);
std::size_t mode_count(const dem::State& state); ///< 0 without the table

/// Table "reference" has one number: weight of the settled discs per length over the flat of the
/// detachment, Pa, by which the load grows where the wall leaves room to the discs.
void set_virtual_pressure(dem::State& state, double pressure);
double virtual_pressure(const dem::State& state);

/// Sums of the discs' vertical pushes, N: at the start and when they were last set. Table "pushes",
/// which only a state with pushes has.
struct PushSums {
    double start = 0.0, now = 0.0;
};
void set_push_sums(dem::State& state, const PushSums& sums);
PushSums push_sums(const dem::State& state);

/// In table "reference", of a footwall on a mesh from a file, also the checksum of that file.
void set_mesh_checksum(dem::State& state, std::uint64_t checksum);
std::optional<std::uint64_t> mesh_checksum(const dem::State& state);

/// What a footwall whose rock relaxes remembers, in tables "creep", "creep_step" and "creep_work".
struct CreepMemory {
    double step;                ///< that has begun, s
    std::vector<double> stress; ///< from before it: fem::Load::stress
    std::vector<double> work;   ///< of the effects' unit loads on the displacement by it, J/m
};
void set_creep(dem::State& state, const CreepMemory& memory);

/// The isotherm that a footwall has, in table "isotherm", and the travel at which it got it.
struct IsothermMemory {
    std::vector<dem::Point> line; ///< m
    double since = 0.0;           ///< m
};
void set_isotherm(dem::State& state, const IsothermMemory& memory);
std::optional<IsothermMemory> isotherm(const dem::State& state); ///< none: it stays elastic

std::optional<double> creep_step(const dem::State& state);   ///< none: nothing relaxes
std::vector<double> creep_stress(const dem::State& state);   ///< empty: nothing relaxes
std::span<const double> creep_work(const dem::State& state); ///< likewise

/// Table "window": a row of sums over the cycles of the window of extension that has begun.
template <bool writable> struct BasicWindowSums {
    using Value = std::conditional_t<writable, double&, const double&>;

    Value cycles;
    Value reaction_error; ///< base reaction over the discs' weight, less 1
    Value net_load;       ///< N
    Value weight_change;  ///< N
};
using WindowSums = BasicWindowSums<true>;
using ConstWindowSums = BasicWindowSums<false>;

WindowSums window_sums(dem::State& state);
ConstWindowSums window_sums(const dem::State& state);

/// Tables "window_means", sums over the cycles of the window that has begun, and "last_window",
/// means over the one that ended last: a row per unknown of the interface.
template <bool writable> struct BasicInterfaceMeans {
    using Values = std::span<std::conditional_t<writable, double, const double>>;

    Values force;        ///< of the discs, relative to the reference, with the virtual ones, N
    Values displacement; ///< m
    Values effects;      ///< loads of the effects, N; empty where there was none
};
using InterfaceMeans = BasicInterfaceMeans<true>;
using ConstInterfaceMeans = BasicInterfaceMeans<false>;

/// @param with_effects  adds their column
InterfaceMeans interface_sums(dem::State& state, bool with_effects);

/// None before a window has ended.
std::optional<ConstInterfaceMeans> last_window_means(const dem::State& state);

/// Begins the interface's sums again, within a window, for a base of another stiffness.
void begin_means_anew(dem::State& state);

/// Makes the means of the window that has begun those of the last window; there are none where it
/// has no cycle, or none since the base has its stiffness.
void keep_window_means(dem::State& state);

/// Sets all sums to zero.
/// @param unknowns  of the interface
void begin_window_sums(dem::State& state, std::size_t unknowns);

} // namespace listric::coupling
