#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/named_numbers.hpp"

namespace listric::measures {

/// How far into the hanging wall the last window's deformation is, beside that of early windows.
NamedNumbers measure_hinge(const RunSoFar& run);

} // namespace listric::measures
