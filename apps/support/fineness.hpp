#pragma once

#include "dem/numbers/elementary.hpp"

#include <cmath>

namespace listric {

/// How much finer than those of a basin the lengths of a small model are told: a power of ten, 1
/// for discs of 10 m and more.
inline double fineness(double mean_radius) {
    return mean_radius > 0.0 && mean_radius < 10.0
               ? dem::power(10.0, std::ceil(dem::logarithm_to_base_10(10.0 / mean_radius)))
               : 1.0;
}

} // namespace listric
