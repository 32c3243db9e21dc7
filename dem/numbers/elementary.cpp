#include "dem/numbers/elementary.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace listric::dem {

namespace {

/// A number as the sum of two, of which the second is at most half a last digit of the first: some
/// 106 bits (T. J. Dekker, "A floating-point technique for extending the available precision",
/// 1971).
struct Pair {
    double high = 0.0, low = 0.0;
};

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Constants to 159 bits, as three numbers.
struct Triple {
    double first, second, third;
};
constexpr Triple half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54, -0x1.f1976b7ed8fbcp-110};
constexpr Triple log_of_2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56, 0x1.7b57a079a1934p-111};
constexpr Pair pi_pair{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Pair one_over_log_of_2{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
constexpr Pair one_over_log_of_10{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};

/// The exact sum (D. E. Knuth, The Art of Computer Programming 2, 4.2.2).
constexpr Pair sum(double a, double b) {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
}

/// The same where |a| >= |b| or a is 0.
constexpr Pair quick_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
}

/// The exact product of numbers below 2^996 (Dekker).
constexpr Pair product(double a, double b) {
    constexpr double splitter = 0x1p27 + 1.0;
    const double a_high = a * splitter - (a * splitter - a), a_low = a - a_high;
    const double b_high = b * splitter - (b * splitter - b), b_low = b - b_high;
    const double p = a * b;
    return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

constexpr Pair operator-(const Pair& a) { return {-a.high, -a.low}; }

constexpr Pair operator+(const Pair& a, const Pair& b) {
    const Pair high = sum(a.high, b.high), low = sum(a.low, b.low);
    const Pair most = quick_sum(high.high, high.low + low.high);
    return quick_sum(most.high, most.low + low.low);
}

constexpr Pair operator*(const Pair& a, const Pair& b) {
    const Pair p = product(a.high, b.high);
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

constexpr Pair operator*(const Pair& a, double b) { return a * Pair{b}; }

constexpr Pair operator/(const Pair& a, const Pair& b) {
    const double first = a.high / b.high;
    const Pair rest = a + -(b * first);
    const double second = rest.high / b.high;
    const Pair last = rest + -(b * second);
    return quick_sum(first, second) + Pair{last.high / b.high};
}

/// 1 / 0 to 1 / 45; that of 0 is 0.
constexpr std::array<Pair, 46> reciprocal = [] {
    std::array<Pair, 46> all{};
    for (std::size_t k = 1; k < all.size(); ++k)
        all[k] = Pair{1.0} / Pair{static_cast<double>(k)};
    return all;
}();

/// 1 / (k (k + 1)).
constexpr std::array<Pair, 28> reciprocal_of_two = [] {
    std::array<Pair, 28> all{};
    for (std::size_t k = 1; k < all.size(); ++k)
        all[k] = Pair{1.0} / Pair{static_cast<double>(k * (k + 1))};
    return all;
}();

Pair root(const Pair& a) {
    if (a.high == 0.0)
        return {};
    const double first = std::sqrt(a.high);
    const Pair rest = a + -product(first, first);
    const Pair better = quick_sum(first, rest.high / (2.0 * first));
    return better + Pair{(a + -(better * better)).high / (2.0 * first)};
}

double rounded(const Pair& a) { return a.high + a.low; }

/// The whole number nearest to x, |x| below 2^51.
double nearest_whole(double x) {
    constexpr double shift = 0x1.8p52;
    return (x + shift) - shift;
}

double scaled(double x, int exponent) { return std::ldexp(x, exponent); } // exact, or rounded once

/// x less k times a constant.
Pair without(const Pair& x, double k, const Triple& constant) {
    const Pair first = product(-k, constant.first), second = product(-k, constant.second);
    Pair rest = sum(x.high, first.high) + (sum(first.low, second.high) + Pair{x.low});
    return rest + Pair{second.low + -k * constant.third};
}

/// exp(x) - 1 of |x| below 0.36.
Pair small_exponential_less_one(const Pair& x) {
    constexpr int halvings = 8;
    const Pair part{0x1p-8 * x.high, 0x1p-8 * x.low};
    Pair all{};
    for (std::size_t k = 9; k > 0; --k) // p (1 + p / 2 (1 + p / 3 (...)))
        all = part * (Pair{1.0} + all) * reciprocal[k];
    for (int k = 0; k < halvings; ++k) // (1 + a)^2 - 1
        all = Pair{2.0 * all.high, 2.0 * all.low} + all * all;
    return all;
}

/// exp(x) of x below 710, by its factor 2^exponent.
Pair exponential(const Pair& x, int& exponent) {
    const double k = nearest_whole(x.high / log_of_2.first);
    exponent = static_cast<int>(k);
    return Pair{1.0} + small_exponential_less_one(without(x, k, log_of_2));
}

double exponential_of(const Pair& x) {
    if (x.high > 710.0)
        return infinite;
    if (x.high < -746.0)
        return 0.0;
    int exponent = 0;
    const Pair result = exponential(x, exponent);
    return scaled(rounded(result), exponent);
}

/// log(x) of a positive, finite number, by 2 atanh((m - 1) / (m + 1)), x = 2^k m, m within a factor
/// sqrt(2) of 1.
Pair logarithm(Pair x) {
    int exponent = 0;
    x.high = std::frexp(x.high, &exponent);
    x.low = scaled(x.low, -exponent);
    if (x.high < 0x1.6a09e667f3bcdp-1) {
        --exponent;
        x = {2.0 * x.high, 2.0 * x.low};
    }
    const Pair t = (x + Pair{-1.0}) / (x + Pair{1.0}), square = t * t;
    Pair series{};
    for (std::size_t k = 45; k < 46; k -= 2)
        series = series * square + reciprocal[k];
    const Pair of_mantissa = series * Pair{2.0 * t.high, 2.0 * t.low};
    if (exponent == 0)
        return of_mantissa;
    const double k = exponent;
    return product(k, log_of_2.first) + (product(k, log_of_2.second) + of_mantissa);
}

/// What a logarithm is where it is no finite number; 0: it is one.
double odd_logarithm(double x) {
    return std::isnan(x) || x < 0.0 ? not_a_number
           : x == 0.0               ? -infinite
           : std::isinf(x)          ? infinite
                                    : 0.0;
}

/// Sine and cosine of an angle up to pi / 4: 1 - x^2 / (2 3) (1 - x^2 / (4 5) (...)) and the like.
Pair small_sine(const Pair& x) {
    const Pair square = x * x;
    Pair series{1.0};
    for (std::size_t k = 26; k > 0; k -= 2)
        series = Pair{1.0} + -(square * series * reciprocal_of_two[k]);
    return x * series;
}

Pair small_cosine(const Pair& x) {
    const Pair square = x * x;
    Pair series{1.0};
    for (std::size_t k = 27; k < 28; k -= 2)
        series = Pair{1.0} + -(square * series * reciprocal_of_two[k]);
    return series;
}

struct Quadrant {
    Pair angle;    ///< within pi / 4 of the quadrant's middle
    unsigned turn; ///< quarters of a turn, 0 to 3
};

Quadrant quadrant_of(double x) {
    const double k = nearest_whole(x / half_pi.first);
    return {without(Pair{x}, k, half_pi), static_cast<unsigned>(static_cast<std::int64_t>(k) & 3)};
}

Pair sine_of(const Quadrant& q) {
    const Pair s = q.turn % 2 == 0 ? small_sine(q.angle) : small_cosine(q.angle);
    return q.turn < 2 ? s : -s;
}

Pair cosine_of(Quadrant q) {
    q.turn = (q.turn + 1) % 4;
    return sine_of(q);
}

/// Arc tangent of a number from 0 to 1, by that of halves of the angle: tan(a / 2) = t / (1 +
/// sqrt(1
/// + t^2)).
Pair small_arc_tangent(Pair t) {
    double factor = 1.0;
    for (; t.high > 0x1p-4; factor *= 2.0)
        t = t / (Pair{1.0} + root(Pair{1.0} + t * t));
    const Pair square = t * t;
    Pair series{};
    for (std::size_t k = t.high < 0x1p-9 ? 11 : 25; k < 26; k -= 2)
        series = reciprocal[k] + -(series * square);
    const Pair angle = t * series;
    return {factor * angle.high, factor * angle.low};
}

/// Direction of (x, y), both at least 0 and not both 0.
Pair direction(const Pair& y, const Pair& x) {
    if (y.high <= x.high)
        return small_arc_tangent(y / x);
    return Pair{half_pi.first, half_pi.second} + -small_arc_tangent(x / y);
}

} // namespace

double sine(double x) {
    if (!(std::abs(x) < 0x1p52))
        return not_a_number;
    return std::abs(x) < 0x1p-27 ? x : rounded(sine_of(quadrant_of(x)));
}

double cosine(double x) {
    if (!(std::abs(x) < 0x1p52))
        return not_a_number;
    return rounded(cosine_of(quadrant_of(x)));
}

double tangent(double x) {
    if (!(std::abs(x) < 0x1p52))
        return not_a_number;
    if (std::abs(x) < 0x1p-27)
        return x;
    const Quadrant q = quadrant_of(x);
    return rounded(sine_of(q) / cosine_of(q));
}

double arc_sine(double x) {
    if (!(std::abs(x) <= 1.0))
        return not_a_number;
    if (std::abs(x) < 0x1p-27)
        return x;
    const Pair size{std::abs(x)};
    const Pair beside = root((Pair{1.0} + -size) * (Pair{1.0} + size));
    return std::copysign(rounded(direction(size, beside)), x);
}

double arc_tangent(double x) {
    if (std::isnan(x) || std::abs(x) < 0x1p-27)
        return x;
    return arc_tangent(x, 1.0);
}

double arc_tangent(double y, double x) {
    if (std::isnan(x) || std::isnan(y))
        return not_a_number;
    double up = std::abs(y), right = std::abs(x);
    const bool left = std::signbit(x);
    if (up == 0.0)
        return std::copysign(left ? pi_pair.high : 0.0, y);
    if (std::isinf(up) || std::isinf(right)) { // corners of a square
        up = std::isinf(up) ? 1.0 : 0.0;
        right = std::isinf(right) ? 1.0 : 0.0;
    }
    // No part of a quotient may leave the range of numbers.
    const int exponent = std::ilogb(std::max(up, right));
    const double high = scaled(up, -exponent), across = scaled(right, -exponent);
    if (high < 0x1p-900 && !left) // below all digits of the quotient that are kept
        return std::copysign(up / right, y);
    Pair angle = direction(Pair{high}, Pair{across});
    if (left)
        angle = pi_pair + -angle;
    return std::copysign(rounded(angle), y);
}

double exponential(double x) { return std::isnan(x) ? x : exponential_of(Pair{x}); }

double exponential_less_one(double x) {
    if (std::isnan(x) || std::abs(x) < 0x1p-60)
        return x;
    if (x > 710.0)
        return infinite;
    if (x < -40.0)
        return -1.0;
    int exponent = 0;
    if (std::abs(x) < 0.34)
        return rounded(small_exponential_less_one(Pair{x}));
    const Pair e = exponential(Pair{x}, exponent);
    if (exponent > 200)
        return scaled(rounded(e), exponent);
    return rounded(Pair{scaled(e.high, exponent), scaled(e.low, exponent)} + Pair{-1.0});
}

double logarithm(double x) {
    const double odd = odd_logarithm(x);
    return odd != 0.0 ? odd : rounded(logarithm(Pair{x}));
}

double logarithm_of_one_and(double x) {
    if (std::abs(x) < 0x1p-60)
        return x;
    const double odd = odd_logarithm(1.0 + x);
    return odd != 0.0 ? odd : rounded(logarithm(sum(1.0, x)));
}

double logarithm_to_base_2(double x) {
    const double odd = odd_logarithm(x);
    return odd != 0.0 ? odd : rounded(logarithm(Pair{x}) * one_over_log_of_2);
}

double logarithm_to_base_10(double x) {
    const double odd = odd_logarithm(x);
    return odd != 0.0 ? odd : rounded(logarithm(Pair{x}) * one_over_log_of_10);
}

double power(double base, double exponent) {
    if (exponent == 0.0 || base == 1.0)
        return 1.0;
    if (std::isnan(base) || std::isnan(exponent))
        return not_a_number;
    const bool is_whole = std::floor(exponent) == exponent;
    const bool is_odd = is_whole && std::abs(exponent) < 0x1p53 && std::fmod(exponent, 2.0) != 0.0;
    const double sign = is_odd && std::signbit(base) ? -1.0 : 1.0, size = std::abs(base);
    if (size == 0.0 || std::isinf(size))
        return sign * ((size == 0.0) == (exponent > 0.0) ? 0.0 : infinite);
    if (base < 0.0 && !is_whole && !std::isinf(exponent))
        return not_a_number;
    if (size == 1.0)
        return sign;
    if (std::isinf(exponent) || std::abs(exponent) > 0x1p70)
        return sign * ((size > 1.0) == (exponent > 0.0) ? infinite : 0.0);
    const Pair log = logarithm(Pair{size});
    if (std::abs(log.high * exponent) > 1e4)
        return sign * (log.high * exponent > 0.0 ? infinite : 0.0);
    return sign * exponential_of(log * Pair{exponent});
}

} // namespace listric::dem
