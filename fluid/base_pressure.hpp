#pragma once

#include "fluid/pore_cells.hpp"

#include <span>
#include <vector>

namespace listric::fluid {

// Excess pressure on a base that bends. Wet discs are lifted by their mud's own volume, and what
// presses on rock and base has the outline of the cells: so pressure there counts by the fill, the
// ratio of the two, and what is still missing to a sum of zero goes to rock and base in proportion
// to the pressure on them.

/// Gives nodes the columns that press_base() fills, and discs that of their lift.
void add_base_pressure(dem::State& state);

/// Fills the nodes' columns `excess_x` and `excess_y`, forces, N, and `excess_size`, magnitude of
/// the pressure times length that they come from, N.
/// @param fill   mud's own volume over that of the cells
/// @param force  on all discs as they act on wet ones, N; those on dry ones are made to balance
/// Returns what was missing over the pressure times length on rock and base.
double press_base(dem::State& state, const dem::RigidBase& base, const PoreCells& cells,
                  std::span<const double> excess_pressure, double fill,
                  std::vector<dem::Point>& force);

} // namespace listric::fluid
