#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>

namespace listric::measures {

/// Basins, and the collapse grabens among them: how many, how deep, and in which order they came.
NamedNumbers measure_grabens(const RunSoFar& run);

std::span<const Quantity> graben_quantities();

} // namespace listric::measures
