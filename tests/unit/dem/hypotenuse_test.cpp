#include "dem/numbers/hypotenuse.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#ifdef __linux__
#include <features.h>
#endif

namespace listric::dem::hypotenuse_test {

namespace {

using Limits = std::numeric_limits<double>;

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

/// Calls f(x, y) with pairs of all kinds: any bits at all, lengths as in a model, and legs whose
/// exponents are near each other anywhere between subnormal numbers and overflow.
template <typename Function> void for_each_pair(int count, Function f) {
    std::mt19937_64 draw(38); // the same numbers with every library, unlike its distributions
    const auto unit = [&] { return 0x1p-53 * static_cast<double>(draw() >> 11); };
    for (int k = 0; k < count; ++k) {
        const std::uint64_t one = draw(), other = draw();
        const double u = unit(), v = unit();
        const int exponent = static_cast<int>(one % 2100) - 1075;
        if (k % 3 == 0)
            f(std::bit_cast<double>(one), std::bit_cast<double>(other));
        else if (k % 3 == 1)
            f(1e4 * (u - 0.5), 1e4 * (v - 0.5));
        else
            f(std::ldexp(u, exponent), std::ldexp(v, exponent - static_cast<int>(other % 60)));
    }
}

} // namespace

// All recorded hashes depend on these bits. The number is that of std::hypot's, of glibc 2.36 on
// x86, with and without fused multiply-add (GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA).
TEST(Hypotenuse, HasRecordedBitsOnAllProcessors) {
    std::uint64_t hash = 0;
    for_each_pair(600'000, [&](double x, double y) {
        const double length = hypotenuse(x, y);
        hash = (hash ^ (std::isnan(length) ? 0 : bits(length))) * 0x100000001b3u;
    });
    EXPECT_EQ(hash, 0xf4bb4cdff04c8733u);
}

// A later C library may round differently; then this says so, and the test above still holds.
#if defined __x86_64__ && defined __GLIBC__ && __GLIBC_MINOR__ >= 35 && __GLIBC_MINOR__ <= 41
TEST(Hypotenuse, HasBitsOfTheCLibrary) {
    int different = 0;
    for_each_pair(600'000, [&](double x, double y) {
        const double ours = hypotenuse(x, y), theirs = std::hypot(x, y);
        different += bits(ours) != bits(theirs) && !(std::isnan(ours) && std::isnan(theirs));
    });
    EXPECT_EQ(different, 0);
}
#endif

TEST(Hypotenuse, KnowsLimits) {
    constexpr double infinity = Limits::infinity(), nan = Limits::quiet_NaN(),
                     least = Limits::denorm_min();
    EXPECT_EQ(bits(hypotenuse(0.0, -0.0)), bits(0.0));
    EXPECT_EQ(hypotenuse(-3.0, 4.0), 5.0);
    EXPECT_EQ(hypotenuse(3.0 * least, 4.0 * least), 5.0 * least);
    EXPECT_EQ(hypotenuse(0x1.8p1022, 0x1p1023), 0x1.4p1023); // 3, 4, 5
    EXPECT_EQ(hypotenuse(Limits::max(), Limits::max()), infinity);
    EXPECT_EQ(hypotenuse(Limits::max(), least), Limits::max());
    EXPECT_EQ(hypotenuse(1.0, 0x1p-54), 1.0);
    for (const double other : {0.0, 1.0, nan, -infinity}) {
        EXPECT_EQ(hypotenuse(-infinity, other), infinity);
        EXPECT_EQ(hypotenuse(other, infinity), infinity);
    }
    for (const double other : {0.0, least, 1.0, Limits::max()}) {
        EXPECT_TRUE(std::isnan(hypotenuse(nan, other)));
        EXPECT_TRUE(std::isnan(hypotenuse(other, nan)));
    }
}

} // namespace listric::dem::hypotenuse_test
