#include "apps/studies/least_squares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace listric {
namespace least_squares_test {

using testing::DoubleNear;
using testing::Optional;
using testing::Pointwise;

using Columns = std::vector<std::vector<double>>;

constexpr double round_off = 1e-14; ///< of a dozen operations on numbers of order 1

TEST(LeastSquares, WeightsGiveTheCoefficientsOfALine) {
    const LeastSquares line({{1.0, 1.0, 1.0, 1.0}, {0.0, 1.0, 2.0, 3.0}});
    EXPECT_EQ(line.rank(), 2u);
    // By the textbook: (x - mean x) / sum of (x - mean x)^2.
    EXPECT_THAT(line.weights(1),
                Optional(Pointwise(DoubleNear(round_off), {-0.3, -0.1, 0.1, 0.3})));
    const std::vector<double> values{1.0, 3.0, 2.0, 4.0};
    EXPECT_NEAR(dot(*line.weights(1), values), 0.8, round_off);
    EXPECT_NEAR(dot(*line.weights(0), values), 1.3, round_off);
    EXPECT_NEAR(line.residual(values), 1.8, 10.0 * round_off);
}

TEST(LeastSquares, TellsNoCoefficientsOfColumnsThatHangTogether) {
    // Indicators of all values of a word make up the constant; the last column is apart from them.
    // Of these sizes what is left of the third is round-off, not 0.
    const LeastSquares model({{0.9, 0.9, 0.9, 0.9, 0.9, 0.9},
                              {0.7, 0.7, 0.7, 0.0, 0.0, 0.0},
                              {0.0, 0.0, 0.0, 0.3, 0.3, 0.3},
                              {-1.0, 0.0, 1.0, -1.0, 0.0, 1.0}});
    EXPECT_EQ(model.rank(), 3u);
    for (const std::size_t hangs : {0u, 1u, 2u})
        EXPECT_EQ(model.weights(hangs), std::nullopt) << hangs;
    EXPECT_THAT(model.weights(3),
                Optional(Pointwise(DoubleNear(round_off), {-0.25, 0.0, 0.25, -0.25, 0.0, 0.25})));
}

TEST(LeastSquares, HasNoMoreRanksThanValues) {
    const LeastSquares model(Columns{{1.0, 1.0}, {0.5, -0.5}, {0.3, 0.7}});
    EXPECT_EQ(model.rank(), 2u);
    EXPECT_NEAR(model.residual(std::vector{3.0, -8.0}), 0.0, 100.0 * round_off);
    EXPECT_EQ(model.weights(2), std::nullopt);
}

/// Powers of numbers up to 1, twelve of which hang together nearly: errors are 1e-11 at most; they
/// would be 3e-9 without the second orthogonalisation.
TEST(LeastSquares, IsAsGoodAsTheConditionOfItsColumnsAllows) {
    constexpr int powers = 12, points = 40;
    Columns columns(powers, std::vector<double>(points));
    std::vector<double> values(points);
    for (int i = 0; i < points; ++i)
        for (int k = 0; k < powers; ++k) {
            const double x = -1.0 + 2.0 * i / (points - 1);
            columns[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] = std::pow(x, k);
            values[static_cast<std::size_t>(i)] += (k + 1) * std::pow(x, k);
        }
    const LeastSquares model(columns);
    EXPECT_EQ(model.rank(), powers);
    for (std::size_t k = 0; k < powers; ++k)
        EXPECT_NEAR(dot(model.weights(k).value(), values), static_cast<double>(k + 1), 1e-10);
}

} // namespace least_squares_test
} // namespace listric
