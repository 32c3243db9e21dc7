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

TEST(FindRoot, LearnsFromWhatItTriedLast) {
    // No place is good, as where contacts open and close; the least error is not the last.
    Broyden broyden = guess();
    std::vector<double> x{0.0, 0.0};
    std::vector<std::vector<double>> places, residuals;
    const auto found = find_root(broyden, x, [&](std::span<const double> place, bool is_last) {
        places.emplace_back(place.begin(), place.end());
        const double side = places.size() % 2 == 0 ? 1.0 : -1.0;
        residuals.push_back({-2.0 * place[0] + 0.3 * side, -30.0 * place[1] + side});
        EXPECT_EQ(is_last, places.size() == 25);
        return Trial{residuals.back(), places.size() == 3 ? 1.0 : 2.0, false};
    });
    EXPECT_FALSE(found);
    ASSERT_EQ(places.size(), 25u);
    EXPECT_EQ(places[24], places[2]);
    EXPECT_EQ(x, places[2]);
    // The step between the last two, which was none of Broyden's.
    const std::vector<double> learned = broyden.step(std::vector<double>{
        residuals[23][0] - residuals[24][0], residuals[23][1] - residuals[24][1]});
    for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(learned[k], places[24][k] - places[23][k], 1e-12);
}

TEST(FindRoot, StopsWhereItIsGood) {
    Broyden broyden = guess();
    std::vector<double> x{0.0, 0.0};
    const auto found = find_root(broyden, x, [&](std::span<const double> place, bool) {
        const std::vector<double> r = residual({place[0], place[1]});
        const double off = std::hypot(r[0], r[1]);
        return Trial{r, off, off < 1e-9};
    });
    EXPECT_TRUE(found);
    EXPECT_LT(error(x), 1e-9);
    EXPECT_FALSE(find_root(broyden, x, [](auto, bool) {
        return Trial{{0.0, 0.0}, std::nan(""), false};
    }));
}

} // namespace
} // namespace listric::coupling
