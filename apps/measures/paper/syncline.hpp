#pragma once

#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>

namespace listric::measures {

/// Basins and rollovers to both sides of the syncline above a ramp-flat-ramp.
NamedNumbers measure_syncline(const RunSoFar& run, const RampFlatRamp& parts);

std::span<const Quantity> syncline_quantities();

} // namespace listric::measures
