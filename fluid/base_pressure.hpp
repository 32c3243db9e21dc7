#pragma once

#include "fluid/pore_cells.hpp"

#include <span>
#include <vector>

namespace listric::fluid {

// Excess pressure on a base that bends. Wet discs are lifted by their mud's own volume, and what
// presses on rock and base has the outline of the cells: so pressure there counts by the ratio of
// the two where pressure changes. The water of the stratum that is to come lifts that, which weighs
// the less on the discs at the ground. What is still missing to a sum of zero goes to rock and base
// in proportion to the pressure on them.

/// Gives nodes the columns that press_base() fills, and discs that of their lift.
void add_base_pressure(dem::State& state);

/// Forces on wet discs over those that their cells would have, in the mean that gives their sum:
/// mud's own volume over that of the cells, but a sand without a gradient counts for nothing, and
/// what is cut of a lift is missing.
double lifted_share(const PoreCells& cells, std::span<const dem::Point> force,
                    std::span<const double> excess_pressure);

/// Adds the lift of the stratum that is to come, by the pressure where the cells at the ground end,
/// to the forces on their discs, N. Where a cell ends above the ground, less is below it. Negative
/// shares take it away.
void lift_what_comes(const PoreCells& cells, std::span<const double> excess_pressure, double share,
                     std::vector<dem::Point>& force);

/// Fills the nodes' columns `excess_x` and `excess_y`, forces, N, and `excess_size`, magnitude of
/// the pressure times length that they come from, N.
/// @param share  of the pressure that counts
/// @param force  on all discs as they act on wet ones, N; those on dry ones are made to balance
/// Returns what was missing over the pressure times length on rock and base.
double press_base(dem::State& state, const dem::RigidBase& base, const PoreCells& cells,
                  std::span<const double> excess_pressure, double share,
                  std::vector<dem::Point>& force);

} // namespace listric::fluid
