#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <optional>
#include <span>

namespace listric::measures {

/// Basins, and the collapse grabens among them: how many, how deep, and in which order they came.
NamedNumbers measure_grabens(const RunSoFar& run);

std::span<const Quantity> graben_quantities();

/// Correlation (Pearson) of two strains of the same discs, over the share of them whose strains are
/// largest in sum; NaN: the disc has no strain. None for fewer than 20 discs.
std::optional<double> strain_correlation(std::span<const double> early,
                                         std::span<const double> late, double share);

/// How much the basement's strain stays where it was: long-lived faults, or short-lived bands.
NamedNumbers measure_persistence(const RunSoFar& run);

std::span<const Quantity> persistence_quantities();

} // namespace listric::measures
