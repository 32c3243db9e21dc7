#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <vector>

#include <span>

namespace listric::measures {

/// Power-cell areas of the basement's discs by id, m^2; 0: not closed, or no such disc.
std::vector<double> rock_cells(const dem::State& state, const dem::RigidBase& base);

/// How much the basement has grown by within, wherever its surface is: measured on its packing, so
/// that the balance of areas can be compared with it.
NamedNumbers measure_dilation(const RunSoFar& run);

std::span<const Quantity> dilation_quantities();

} // namespace listric::measures
