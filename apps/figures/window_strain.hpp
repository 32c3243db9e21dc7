#pragma once

#include "apps/scene/effect.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Shear strain of discs in the last window that has ended, or before the end of the first one
/// since the start, by row. NaN: sediment that was deposited since the window began.
std::vector<double> window_strain(const Observation& now);

/// That without what settling_of() names, as pictures have it; none where an older program has left
/// no such numbers.
std::optional<std::vector<double>> window_tectonic_strain(const Observation& now);

/// The sum of it since the start; none likewise.
std::optional<std::vector<double>> total_tectonic_strain(const Observation& now);

/// What a picture of strain is without, or with, in words behind a label: " without compaction";
/// empty where nothing settles.
std::string strain_remark(const Observation& now, bool is_tectonic);

} // namespace listric
