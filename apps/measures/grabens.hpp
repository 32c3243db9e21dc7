#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/named_numbers.hpp"

#include <optional>

namespace listric::measures {

/// Basins, and the collapse grabens among them: how many, how deep, and in which order they came.
/// @param intervening_high  x and depth, m
NamedNumbers measure_grabens(const RunSoFar& run,
                             const std::optional<dem::Point>& intervening_high);

} // namespace listric::measures
