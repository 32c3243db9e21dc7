#pragma once

#include <array>
#include <charconv>
#include <cmath>

namespace listric::dem {

/// A number to twelve digits: what a short decimal number was before products and quotients left
/// their round-off in it. Values that are one and the same by two ways of reckoning get equal bits.
inline double without_round_off(double x) {
    if (!std::isfinite(x))
        return x;
    std::array<char, 32> digits{};
    const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), x,
                                       std::chars_format::scientific, 11);
    double rounded = x;
    std::from_chars(digits.data(), written.ptr, rounded);
    return rounded;
}

} // namespace listric::dem
