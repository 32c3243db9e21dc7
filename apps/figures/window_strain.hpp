#pragma once

#include "apps/scene/effect.hpp"

#include <vector>

namespace listric {

/// Shear strain of discs in the last window that has ended, or before the end of the first one
/// since the start, by row. NaN: sediment that was deposited since the window began.
std::vector<double> window_strain(const Observation& now);

} // namespace listric
