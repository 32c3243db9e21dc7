// Broyden's method on equations whose root is known.

#include "coupling/broyden.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace listric::coupling {
namespace {

constexpr double root[] = {0.5, -0.25};

/// A soft and a stiff spring that are coupled and harden; zero at `root`.
std::vector<double> residual(const std::vector<double>& x) {
    const double u = x[0] - root[0], v = x[1] - root[1];
    return {-(2.0 * u + 0.5 * v + u * u * u), -(0.5 * u + 30.0 * v + 4.0 * v * v)};
}

double error(const std::vector<double>& x) { return std::hypot(x[0] - root[0], x[1] - root[1]); }

/// Steps from 0 until the residual is `allowed`, 100 at most.
int steps_to_root(Broyden& broyden, bool learns, double allowed, std::vector<double>& x) {
    x = {0.0, 0.0};
    std::vector<double> r = residual(x);
    for (int steps = 0; steps < 100; ++steps) {
        if (std::hypot(r[0], r[1]) < allowed)
            return steps;
        const std::vector<double> step = broyden.step(r), before = r;
        for (std::size_t k = 0; k < 2; ++k)
            x[k] += step[k];
        r = residual(x);
        if (learns)
            broyden.update(step, std::vector<double>{r[0] - before[0], r[1] - before[1]});
    }
    return 100;
}

/// The uncoupled springs, each three times too stiff.
Broyden guess() { return Broyden({1.0 / 6.0, 0.0, 0.0, 1.0 / 90.0}); }

TEST(Broyden, FindsTheRootFasterThanWithoutLearning) {
    std::vector<double> x;
    Broyden learning = guess(), fixed = guess();
    const int steps = steps_to_root(learning, true, 1e-12, x);
    EXPECT_LT(error(x), 1e-12); // the stiffness is above 1
    // Superlinear; without learning two thirds of the error stay in each step.
    EXPECT_LT(steps, 15);
    EXPECT_GT(steps_to_root(fixed, false, 1e-12, x), 60);
}

TEST(Broyden, AgreesWithTheLastChange) {
    Broyden broyden = guess();
    const std::vector<double> step{0.3, -0.1}, change{-0.8, 2.5};
    broyden.update(step, change);
    // (-dr/dx)^-1 applied to -change is the step.
    const std::vector<double> again = broyden.step(std::vector<double>{0.8, -2.5});
    EXPECT_NEAR(again[0], step[0], 1e-15);
    EXPECT_NEAR(again[1], step[1], 1e-15);
}

TEST(Broyden, RestartForgets) {
    Broyden broyden = guess();
    const std::vector<double> r{1.0, 2.0}, first = broyden.step(r);
    broyden.update(std::vector<double>{0.3, -0.1}, std::vector<double>{-0.8, 2.5});
    EXPECT_NE(broyden.step(r), first);
    broyden.restart();
    EXPECT_EQ(broyden.step(r), first);
    // A change that says nothing about the step leaves the approximation as it is.
    broyden.update(std::vector<double>{1.0, 0.0}, std::vector<double>{0.0, 1.0});
    EXPECT_EQ(broyden.step(r), first);
}

} // namespace
} // namespace listric::coupling
