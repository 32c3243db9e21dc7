// Keyed random numbers: a number is a function of its key alone. Statistics over n = 1e5 keys are
// bounded by five standard errors, which a sound generator violates once in two million seeds; the
// keys are fixed, so a test that passes once passes always.

#include <gtest/gtest.h>

#include "dem/numbers/random.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace listric::random_test {

using namespace dem;
namespace {

constexpr std::uint64_t n = 100000;
const double root_n = std::sqrt(static_cast<double>(n));

TEST(Random, OrderDoesNotMatter) {
    std::vector<double> forward, backward;
    for (std::uint64_t k = 0; k < 1000; ++k)
        forward.push_back(normal(7, Purpose::bond_shear, k, 2 * k));
    for (std::uint64_t k = 1000; k-- > 0;)
        backward.push_back(normal(7, Purpose::bond_shear, k, 2 * k));
    std::ranges::reverse(backward);
    EXPECT_EQ(forward, backward);
}

TEST(Random, EveryWordOfTheKeyMatters) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t seed : {1, 2})
        for (Purpose purpose : {Purpose::bond_tension, Purpose::bond_shear})
            for (std::uint64_t a : {0, 1, 2})
                for (std::uint64_t b : {0, 1, 2})
                    for (std::uint64_t c : {0, 1, 2})
                        seen.insert(random_bits(seed, purpose, a, b, c));
    EXPECT_EQ(seen.size(), 2u * 2u * 27u); // (a, b) differs from (b, a)
}

TEST(Random, NormalHasMeanZeroAndVarianceOne) {
    double sum = 0.0, squares = 0.0, cubes = 0.0;
    for (std::uint64_t k = 0; k < n; ++k) {
        const double z = normal(1, Purpose::bond_tension, k, k + 1);
        sum += z;
        squares += z * z;
        cubes += z * z * z;
    }
    const auto count = static_cast<double>(n);
    EXPECT_NEAR(sum / count, 0.0, 5.0 / root_n);
    EXPECT_NEAR(squares / count, 1.0, 5.0 * std::sqrt(2.0) / root_n);
    EXPECT_NEAR(cubes / count, 0.0, 5.0 * std::sqrt(15.0) / root_n);
}

TEST(Random, NormalHasNormalTails) {
    // P(|z| > 1.96) = 0.05, P(|z| > 3) = 0.0027; binomial standard error sqrt(p (1 - p) / n).
    double beyond_2 = 0.0, beyond_3 = 0.0;
    for (std::uint64_t k = 0; k < n; ++k) {
        const double z = std::abs(normal(3, Purpose::bond_shear, k));
        beyond_2 += z > 1.959964;
        beyond_3 += z > 3.0;
    }
    const auto count = static_cast<double>(n);
    EXPECT_NEAR(beyond_2 / count, 0.05, 5.0 * std::sqrt(0.05 * 0.95) / root_n);
    EXPECT_NEAR(beyond_3 / count, 0.0027, 5.0 * std::sqrt(0.0027) / root_n);
}

TEST(Random, UniformFillsTheUnitInterval) {
    constexpr int bins = 100;
    std::vector<double> count(bins, 0.0);
    for (std::uint64_t k = 0; k < n; ++k) {
        const double u = uniform(5, Purpose::packing_place, k, 1);
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        count[static_cast<std::size_t>(bins * u)] += 1.0;
    }
    const double expected = static_cast<double>(n) / bins;
    double chi_square = 0.0;
    for (double c : count)
        chi_square += (c - expected) * (c - expected) / expected;
    // 99 degrees of freedom: mean 99, standard deviation sqrt(2 * 99).
    EXPECT_NEAR(chi_square, 99.0, 5.0 * std::sqrt(2.0 * 99.0));
}

TEST(Random, PurposesSeedsAndNeighboursAreUncorrelated) {
    double purpose = 0.0, seed = 0.0, neighbour = 0.0;
    for (std::uint64_t k = 0; k < n; ++k) {
        const double z = normal(1, Purpose::bond_tension, k);
        purpose += z * normal(1, Purpose::bond_shear, k);
        seed += z * normal(2, Purpose::bond_tension, k);
        neighbour += z * normal(1, Purpose::bond_tension, k + 1);
    }
    // A product of independent standard normals has variance one.
    EXPECT_NEAR(purpose / static_cast<double>(n), 0.0, 5.0 / root_n);
    EXPECT_NEAR(seed / static_cast<double>(n), 0.0, 5.0 / root_n);
    EXPECT_NEAR(neighbour / static_cast<double>(n), 0.0, 5.0 / root_n);
}

} // namespace
} // namespace listric::random_test
