#include "apps/laboratory/calibration/gauss_newton.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace listric::gauss_newton_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Le;

GaussNewton problem(std::function<std::vector<double>(const TwoParameters&)> errors) {
    return {.errors = std::move(errors),
            .lower = {-10.0, -10.0},
            .upper = {10.0, 10.0},
            .difference = {0.1, 0.1},
            .longest = {10.0, 10.0},
            .rounds = 20,
            .enough = 1e-12,
            .shortest = 1e-9};
}

// Three lines that meet in (2, -1). The step is damped by 1e-4 of about 6, so each round leaves a
// few 1e-5 of the distance.
TEST(GaussNewton, FindsWhereLinearErrorsVanish) {
    const auto found =
        problem([](const TwoParameters& x) {
            return std::vector{x[0] + x[1] - 1.0, x[0] - x[1] - 3.0, 2.0 * x[0] + x[1] - 3.0};
        }).minimise({0.0, 0.0});
    EXPECT_THAT(found, ElementsAre(DoubleNear(2.0, 1e-8), DoubleNear(-1.0, 1e-8)));
}

// An exponential through two of its values: bent as the strengths are that it is made for.
TEST(GaussNewton, FindsTheParametersOfACurve) {
    const auto curve = [](const TwoParameters& x, double at) { return x[0] * std::exp(x[1] * at); };
    const TwoParameters truth{1.5, 0.7};
    const auto found = problem([&](const TwoParameters& x) {
                           std::vector<double> e;
                           for (double at : {0.0, 1.0, 2.0})
                               e.push_back(curve(x, at) / curve(truth, at) - 1.0);
                           return e;
                       }).minimise({1.0, 0.3});
    EXPECT_THAT(found, ElementsAre(DoubleNear(1.5, 1e-6), DoubleNear(0.7, 1e-6)));
}

TEST(GaussNewton, StaysWithinItsBoundsAndItsLongestMove) {
    GaussNewton bounded = problem([](const TwoParameters& x) {
        return std::vector{x[0] - 5.0, x[1]};
    });
    bounded.upper = {2.0, 10.0};
    bounded.longest = {0.5, 0.5};
    bounded.rounds = 2;
    EXPECT_THAT(bounded.minimise({0.0, 0.0}), ElementsAre(DoubleNear(1.0, 1e-12), 0.0));
    bounded.rounds = 20;
    EXPECT_THAT(bounded.minimise({0.0, 0.0}), ElementsAre(2.0, 0.0));
}

// Rounds that make it worse are not what is returned; and it ends when the errors are small enough.
TEST(GaussNewton, ReturnsTheBestPointThatItMet) {
    int calls = 0;
    GaussNewton misled = problem([&](const TwoParameters& x) {
        ++calls;
        return std::vector{x[0] == 1.0 && x[1] == 1.0 ? 0.5 : 1.0 + std::abs(x[0]), 0.1};
    });
    misled.rounds = 3;
    EXPECT_THAT(misled.minimise({1.0, 1.0}), ElementsAre(1.0, 1.0));
    calls = 0;
    misled.enough = 0.5;
    misled.minimise({1.0, 1.0});
    EXPECT_THAT(calls, Le(3)); // the start and two differences
}

} // namespace
} // namespace listric::gauss_newton_test
