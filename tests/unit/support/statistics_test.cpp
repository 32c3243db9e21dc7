// Limits of a probability against those that are known in closed form or by tables.

#include "apps/support/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::statistics_test {
namespace {

TEST(ProbabilityLimits, OfAllAndOfNoneAreRoots) {
    // n of n: p^n = 0.05.
    for (const int n : {1, 4, 5, 20, 1000}) {
        EXPECT_NEAR(probability_limits(n, n).lower, std::pow(0.05, 1.0 / n), 1e-12) << n;
        EXPECT_EQ(probability_limits(n, n).upper, 1.0);
        EXPECT_EQ(probability_limits(0, n).lower, 0.0);
        EXPECT_NEAR(probability_limits(0, n).upper, 1.0 - std::pow(0.05, 1.0 / n), 1e-12) << n;
    }
    EXPECT_EQ(probability_limits(0, 0).lower, 0.0);
    EXPECT_EQ(probability_limits(0, 0).upper, 1.0);
}

// By bisection of the binomial sums in decimal numbers of 60 digits. Ours are differences of
// logarithms of up to 6,000, of which round-off leaves 1e-12.
TEST(ProbabilityLimits, AreThoseOfTheTables) {
    const struct {
        int met, of;
        double lower, upper;
    } known[] = {{4, 5, 0.3425916819988613, 0.9897937816869885},
                 {15, 20, 0.5444175959982511, 0.8959191640898639},
                 {14, 20, 0.4921815933852067, 0.8604462509976136},
                 {5, 20, 0.1040808359101361, 0.4555824040017488},
                 {500, 1000, 0.4735177312356912, 0.5264822687643088}};
    for (const auto& k : known) {
        EXPECT_NEAR(probability_limits(k.met, k.of).lower, k.lower, 1e-10) << k.met;
        EXPECT_NEAR(probability_limits(k.met, k.of).upper, k.upper, 1e-10) << k.met;
    }
}

} // namespace
} // namespace listric::statistics_test
