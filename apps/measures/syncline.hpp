#pragma once

#include "apps/measures/blocks.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/named_numbers.hpp"

namespace listric::measures {

/// Basins and rollovers to both sides of the syncline above a ramp-flat-ramp.
NamedNumbers measure_syncline(const RunSoFar& run, const RampFlatRamp& parts);

} // namespace listric::measures
