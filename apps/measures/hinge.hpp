#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>

namespace listric::measures {

/// How far into the hanging wall the last window's deformation is, beside that of early windows.
NamedNumbers measure_hinge(const RunSoFar& run);

std::span<const Quantity> hinge_quantities();

} // namespace listric::measures
