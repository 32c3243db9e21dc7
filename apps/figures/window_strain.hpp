#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Shear strain of discs in the last window that has ended, or before the end of the first one
/// since the start, by row. NaN: sediment that was deposited since the window began.
std::vector<double> window_strain(const Observation& now);

/// Shear strain of discs since the start, or since they were deposited, by row.
std::vector<double> total_strain(const Observation& now);

/// Strain of the window without what settling_of() names, as pictures have it; none where an older
/// program has left no such numbers.
std::optional<std::vector<double>> window_tectonic_strain(const Observation& now);

/// All strains that a moment knows, by the names of their columns; those without settling where
/// something settles.
std::map<std::string, std::vector<double>> strains_of(const Observation& now);

/// Words behind a label for what a picture of strain is without, or with: " without " and
/// settling_of(); empty where nothing settles.
std::string strain_remark(const Observation& now, bool is_tectonic);

} // namespace listric
