#pragma once

#include "thermal/heat.hpp"

#include <span>
#include <vector>

namespace listric::thermal {

/// Mass that thermal expansion has taken from the columns since the start, kg/m^2; below 0 where
/// they are colder: the integral over depth of expansion times density times what a place is warmer
/// than it was at the start. At each knot the mean weighted with the line that is 1 there and 0 at
/// the knots beside it: what lies between the outermost knots counts once.
///
/// Density is that of what is there now, without expansion: its difference from what was there is
/// load by itself, and with discs counted as their weight. Sediment above the ground of the start
/// has the density that it weighs with at the ground's temperature.
/// @param knots  ascending, m; at least two
std::vector<double> mass_lost(const Heat& heat, const dem::State& state, const dem::RigidBase& base,
                              std::span<const double> knots);

} // namespace listric::thermal
