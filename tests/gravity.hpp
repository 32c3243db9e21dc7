#pragma once

namespace listric::support {

inline constexpr double gravity = 9.81; ///< m/s^2

} // namespace listric::support
