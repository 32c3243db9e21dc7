#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>

namespace listric::measures {

/// Whether faults surround the block on the lower ramp of a ramp-flat-ramp, and how many gentle
/// ones are near it. Nothing if hardly any of the block is left.
NamedNumbers measure_lower_block(const RunSoFar& run, const RampFlatRamp& parts,
                                 std::span<const Fault> faults);

std::span<const Quantity> lower_block_quantities();

} // namespace listric::measures
