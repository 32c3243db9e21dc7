#pragma once

#include "fluid/pore_cells.hpp"

#include <span>
#include <vector>

namespace listric::fluid {

// Excess pressure on a base that bends. Wet discs are lifted by their mud's own volume, and what
// presses on rock and base has the outline of the cells, which gaps are a part of: so there presses
// what the lifts above add up to, a pressure whose slopes are those of the forces on the discs, by
// least squares. Along level ways slopes by the volume do not add up, where mud is less full than
// rock: so that pressure pushes the discs sideways itself. The water of the stratum that is to come
// lifts that, which weighs the less on the discs at the ground.

/// Gives nodes the columns that press_base() fills, and discs that of their lift.
void add_base_pressure(dem::State& state);

/// Adds the lift of the stratum that is to come, which begins at the smooth ground, to the forces
/// on the discs below it, N. Where cells end above the ground of others, less or more is there.
void lift_what_comes(const PoreCells& cells, std::span<const double> excess_pressure,
                     std::span<dem::Point> force);

/// Fills the nodes' columns `excess_x` and `excess_y`, forces, N, and `excess_size`, magnitude of
/// the pressure times length that they come from, N.
/// @param force  on all discs, N: upward ones on wet discs as they act; the others are made
/// Returns what was missing to a sum of zero over the pressure times length on rock and base, which
/// are given it.
double press_base(dem::State& state, const dem::RigidBase& base, const PoreCells& cells,
                  std::span<const double> excess_pressure, std::span<dem::Point> force);

} // namespace listric::fluid
