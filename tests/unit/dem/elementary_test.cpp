#include "dem/numbers/elementary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace listric::dem::elementary_test {

namespace {

using Limits = std::numeric_limits<double>;
constexpr double infinity = Limits::infinity(), nan = Limits::quiet_NaN();

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

using One = double (*)(double);
using Long = long double (*)(long double);

/// A function, that of the C library in a longer number, and arguments from `least` to `most`:
/// where `by_size`, of all sizes between these powers of 2 and both signs.
struct Case {
    const char* name;
    One ours;
    Long longer;
    double least, most;
    bool by_size = false;
};

const Case cases[] = {
    {"sine", sine, std::sin, -1e4, 1e4},
    {"sine", sine, std::sin, -60.0, 30.0, true},
    {"cosine", cosine, std::cos, -1e4, 1e4},
    {"tangent", tangent, std::tan, -1e4, 1e4},
    {"arc sine", arc_sine, std::asin, -1.0, 1.0},
    {"arc tangent", arc_tangent, std::atan, -80.0, 80.0, true},
    {"exponential", exponential, std::exp, -708.0, 709.0},
    {"exponential less one", exponential_less_one, std::expm1, -60.0, 9.0, true},
    {"logarithm", logarithm, std::log, 0.5, 2.0},
    {"logarithm to base 2", logarithm_to_base_2, std::log2, 1e-9, 1e9},
    {"logarithm to base 10", logarithm_to_base_10, std::log10, 1e-9, 1e9},
    {"logarithm of 1 + x", logarithm_of_one_and, std::log1p, -0.9, 10.0},
};

/// Calls f with arguments of a case, the same with every library.
template <typename Function> void for_each_argument(const Case& c, int count, Function f) {
    std::mt19937_64 draw(38);
    const auto unit = [&] { return 0x1p-53 * static_cast<double>(draw() >> 11); };
    for (int k = 0; k < count; ++k) {
        const double u = unit(), between = c.least + (c.most - c.least) * u;
        if (c.by_size)
            f(std::ldexp(1.0 + unit(), static_cast<int>(between)) * (k % 2 ? 1.0 : -1.0));
        else
            f(between);
    }
}

/// How far a result is from the one in longer numbers, units of its last digit.
long double error_of(double ours, long double exact) {
    const double unit = std::nextafter(std::abs(ours), infinity) - std::abs(ours);
    return std::abs(static_cast<long double>(ours) - exact) / unit;
}

} // namespace

// The C library's long double has 11 digits more and an error of about one of its own last digits.
// Rounded correctly a result is within half a digit of the exact one.
TEST(Elementary, IsRoundedCorrectly) {
    for (const Case& c : cases) {
        long double worst = 0.0;
        for_each_argument(c, 20'000, [&](double x) {
            worst = std::max(worst, error_of(c.ours(x), c.longer(x)));
        });
        EXPECT_LT(worst, 0.502L) << c.name;
        EXPECT_GT(worst, 0.4L) << c.name; // it was looked for
    }
    long double worst = 0.0;
    for_each_argument({"", nullptr, nullptr, -20.0, 20.0, true}, 20'000, [&](double x) {
        const double y = 1.0 + std::abs(std::fmod(1e3 * x, 1.0));
        for (const double across : {x, -y})
            worst = std::max(worst,
                             error_of(arc_tangent(y, across), std::atan2(1.0L * y, 1.0L * across)));
        worst = std::max(worst, error_of(power(y, std::fmod(x, 30.0)),
                                         std::pow(1.0L * y, 1.0L * std::fmod(x, 30.0))));
    });
    EXPECT_LT(worst, 0.502L);
}

// All recorded hashes depend on these bits, with any compiler, processor and C library.
TEST(Elementary, HasRecordedBitsEverywhere) {
    std::uint64_t hash = 0;
    const auto add = [&](double value) {
        hash = (hash ^ (std::isnan(value) ? 0 : bits(value))) * 0x100000001b3u;
    };
    for (const Case& c : cases)
        for_each_argument(c, 20'000, [&](double x) { add(c.ours(x)); });
    for_each_argument({"", nullptr, nullptr, -20.0, 20.0, true}, 20'000, [&](double x) {
        add(arc_tangent(x, 0.5));
        add(power(std::abs(x), 1.7));
    });
    EXPECT_EQ(hash, 0x4c2aef503152c13bu);
}

// Results that are exact, and those with more equal digits behind the last than chance gives (found
// with 200 digits): rounding goes the right way.
TEST(Elementary, KnowsExactResults) {
    EXPECT_EQ(power(10.0, 15.0), 1e15);
    EXPECT_EQ(power(10.0, -3.0), 1e-3);
    EXPECT_EQ(power(1.5, 3.0), 3.375);
    EXPECT_EQ(power(4.0, 0.5), 2.0);
    EXPECT_EQ(power(-2.0, 3.0), -8.0);
    EXPECT_EQ(logarithm_to_base_2(0x1p-700), -700.0);
    EXPECT_EQ(logarithm_to_base_10(1e22), 22.0);
    EXPECT_EQ(sine(0x1p-40), 0x1p-40);
    EXPECT_EQ(cosine(0.0), 1.0);
    EXPECT_EQ(exponential(1.0), 0x1.5bf0a8b145769p+1);
    EXPECT_EQ(4.0 * arc_tangent(1.0), 0x1.921fb54442d18p+1);
}

TEST(Elementary, KnowsLimits) {
    for (const One odd : {One{sine}, One{tangent}, One{arc_sine}, One{arc_tangent},
                          One{exponential_less_one}, One{logarithm_of_one_and}}) {
        EXPECT_EQ(bits(odd(0.0)), bits(0.0));
        EXPECT_EQ(bits(odd(-0.0)), bits(-0.0));
        EXPECT_EQ(odd(Limits::denorm_min()), Limits::denorm_min());
    }
    for (const Case& c : cases)
        EXPECT_TRUE(std::isnan(c.ours(nan))) << c.name;
    EXPECT_TRUE(std::isnan(sine(infinity)) && std::isnan(cosine(-infinity)));
    EXPECT_TRUE(std::isnan(arc_sine(1.0000001)) && std::isnan(logarithm(-1.0)));
    EXPECT_TRUE(std::isnan(power(-2.0, 0.5)));
    EXPECT_EQ(logarithm(0.0), -infinity);
    EXPECT_EQ(logarithm(infinity), infinity);
    EXPECT_EQ(exponential(-infinity), 0.0);
    EXPECT_EQ(exponential(infinity), infinity);
    EXPECT_EQ(exponential(710.0), infinity);
    EXPECT_EQ(exponential(-746.0), 0.0);
    EXPECT_EQ(exponential(-745.0), Limits::denorm_min());
    EXPECT_EQ(exponential_less_one(-infinity), -1.0);
    EXPECT_EQ(power(0.0, -1.0), infinity);
    EXPECT_EQ(bits(power(-0.0, 3.0)), bits(-0.0));
    EXPECT_EQ(power(nan, 0.0), 1.0);
    EXPECT_EQ(power(1e300, 2.0), infinity);
    EXPECT_EQ(power(0.5, infinity), 0.0);
    const double half_pi = 2.0 * arc_tangent(1.0);
    EXPECT_EQ(arc_tangent(infinity), half_pi);
    EXPECT_EQ(arc_tangent(1.0, 0.0), half_pi);
    EXPECT_EQ(arc_tangent(0.0, -1.0), 2.0 * half_pi);
    EXPECT_EQ(arc_tangent(-0.0, -1.0), -2.0 * half_pi);
    EXPECT_EQ(bits(arc_tangent(-0.0, 1.0)), bits(-0.0));
    EXPECT_EQ(arc_tangent(-infinity, infinity), -0.5 * half_pi);
}

} // namespace listric::dem::elementary_test
