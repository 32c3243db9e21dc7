#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>

namespace listric::measures {

/// How far the deformation lies in the hanging wall in the last window, beside early windows.
NamedNumbers measure_hinge(const RunSoFar& run);

std::span<const Quantity> hinge_quantities();

} // namespace listric::measures
