#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace listric::dem {

// Sums and maxima that come out the same in whatever order and by however many their parts are
// taken together.

/// The greater of two numbers that are not negative. NaN is greater than all, so that no maximum
/// hides it: the bits of such numbers are in their order, and those of NaN above them.
inline double greater(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) < std::bit_cast<std::uint64_t>(b) ? b : a;
}

/// A sum of doubles below 2^62 in magnitude, of at most 2^31 of them: each is rounded to a fixed
/// grid of 2^-34 and added as integers.
class OrderFreeSum {
public:
    void operator+=(double number) {
        const double high = std::floor(number * 0x1p-30);
        const double rest = number - high * 0x1p30; // exact, in [0, 2^30)
        const double middle = std::floor(rest * 0x1p2);
        high_ += static_cast<std::int64_t>(high);
        middle_ += static_cast<std::int64_t>(middle);
        low_ += std::llrint((rest - middle * 0x1p-2) * 0x1p34);
    }
    void operator+=(const OrderFreeSum& other) {
        high_ += other.high_;
        middle_ += other.middle_;
        low_ += other.low_;
    }
    double value() const {
        // Carries first: equal sums must not differ in how they are shared among the parts.
        const std::int64_t middle = middle_ + (low_ >> 32);
        const std::int64_t high = high_ + (middle >> 32);
        constexpr std::int64_t mask = 0xffffffff;
        return static_cast<double>(high) * 0x1p30 + (static_cast<double>(middle & mask) * 0x1p-2 +
                                                     static_cast<double>(low_ & mask) * 0x1p-34);
    }

private:
    std::int64_t high_ = 0, middle_ = 0, low_ = 0; ///< in 2^30, 2^-2 and 2^-34
};

/// Unit in which loads on nodes are counted, N/m: a hanging wall's loads are a thousand million
/// millions of it.
inline constexpr double load_unit = 0x1p-10;

/// A load as a number of units. Sums up to 9e15 N/m fit.
inline std::int64_t load_units(double load) { return std::llrint(load * (1.0 / load_unit)); }

} // namespace listric::dem
