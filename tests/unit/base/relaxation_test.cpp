// Maxwell's rock over a step, and stress that another mesh takes over.

#include "fem/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace listric::relaxation_test {

namespace {

using fem::maxwell;
using fem::StressPoint;
using fem::Vector;

/// Stress after `steps` steps of `step` s in which strain grows at `rate`, 1/s.
double stress_after(int steps, double step, double rate, double modulus, double time,
                    double stress = 0.0) {
    const fem::Maxwell over = maxwell(step, time);
    for (int k = 0; k < steps; ++k)
        stress = over.decay * stress + 2.0 * modulus * over.share * rate * step;
    return stress;
}

/// Gerya and Yuen (2007), as ASPECT's viscoelastic_stress_build-up: 2 eta rate (1 - e^(-t / time)).
/// Exact for the scheme, so that only round-off is left.
TEST(Maxwell, StressBuildsUpUnderASteadyRate) {
    constexpr double viscosity = 1e22, modulus = 1e10, rate = 1e-14, year = 365.25 * 86400.0;
    constexpr double time = viscosity / modulus;
    for (const int steps : {1, 10, 250}) {
        const auto after = [&](double years) {
            return stress_after(steps, years * year / steps, rate, modulus, time);
        };
        for (const double years : {25e3, 250e3}) {
            const double exact = -2.0 * viscosity * rate * std::expm1(-years * year / time);
            // Where a step's share of the modulus is not at its floor.
            EXPECT_NEAR(after(years) / exact, 1.0, 1e-10) << steps << " " << years;
        }
        EXPECT_NEAR(after(25e3) / 1e6, 109.1, 0.05);
        EXPECT_NEAR(after(250e3) / 1e6, 199.9, 0.05);
    }
}

TEST(Maxwell, HeldStrainShedsItsStress) {
    for (const double times : {1.0, 3.0})
        EXPECT_NEAR(stress_after(8, times / 8.0, 0.0, 5.0, 1.0, 7.0), 7.0 * std::exp(-times),
                    1e-10);
}

TEST(Maxwell, HeldStressStrainsOn) {
    constexpr double modulus = 5.0, stress = 7.0;
    const fem::Maxwell over = maxwell(0.25, 1.0);
    double strain = stress / (2.0 * modulus); // at once
    const double at_once = strain;
    for (int k = 1; k <= 12; ++k) {
        strain += (1.0 - over.decay) * stress / (2.0 * modulus * over.share);
        if (k == 4 || k == 12) {
            EXPECT_NEAR(strain / at_once, k == 4 ? 2.0 : 4.0, 1e-6);
        }
    }
}

TEST(Maxwell, HasItsLimits) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(maxwell(0.0, 1.0).share, 1.0);
    EXPECT_EQ(maxwell(1.0, infinite).share, 1.0);
    EXPECT_EQ(maxwell(1.0, infinite).decay, 1.0);
    EXPECT_EQ(maxwell(1e9, 1.0).share, fem::least_share);
    EXPECT_EQ(maxwell(1e9, 1.0).decay, 0.0);
    EXPECT_NEAR(maxwell(1e-9, 1.0).share, 1.0 - 0.5e-9, 1e-15);
}

/// Three by three points in each of two elements side by side, the second of two rocks.
std::vector<StressPoint> points() {
    std::vector<StressPoint> points;
    for (std::size_t cell = 0; cell < 2; ++cell)
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                points.push_back(
                    {{static_cast<double>(cell) + (0.5 + column) / 3.0, (0.5 + row) / 3.0},
                     cell == 1 && row == 2 ? 9.0 : 1.0,
                     cell});
    return points;
}

TEST(StressPoints, AnotherMeshTakesAStressThatIsStraight) {
    const std::vector<StressPoint> from = points();
    std::vector<double> stress;
    for (const StressPoint& p : from)
        for (double c : {1.0, 2.0, 3.0})
            stress.push_back(c + 5.0 * p.place.x - c * p.place.y);
    const std::vector<StressPoint> to = {
        {{0.1, 0.1}, 1.0, 0}, {{0.9, 0.7}, 1.0, 0}, {{1.2, 0.2}, 1.0, 1}};
    const std::vector<double> found = carried_over(from, stress, to);
    for (std::size_t k = 0; k < to.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c) {
            const double factor = static_cast<double>(c) + 1.0;
            EXPECT_NEAR(found[3 * k + c], factor + 5.0 * to[k].place.x - factor * to[k].place.y,
                        1e-12);
        }
}

TEST(StressPoints, RocksOfAnElementKeepTheirOwn) {
    const std::vector<StressPoint> from = points();
    std::vector<double> stress;
    for (const StressPoint& p : from)
        stress.insert(stress.end(), 3, p.relaxation_time);
    const std::vector<StressPoint> to = {{{1.4, 0.9}, 9.0, 1}, {{1.4, 0.4}, 1.0, 1}};
    const std::vector<double> found = carried_over(from, stress, to);
    EXPECT_NEAR(found[0], 9.0, 1e-12); // a row of points: its mean
    EXPECT_NEAR(found[3], 1.0, 1e-12);
    EXPECT_TRUE(fem::carried_over({}, {}, {}).empty());
}

/// A column of points that stand in a line but for round-off says nothing of what lies beside it.
TEST(StressPoints, ALineIsNoPlane) {
    const std::vector<StressPoint> from = {
        {{1e5, 0.0}, 1.0, 0}, {{1e5 + 1e-11, 1e3}, 1.0, 0}, {{1e5, 2e3}, 1.0, 0}};
    const std::vector<double> stress = {1, 1, 1, 2, 2, 2, 3, 3, 3};
    const std::vector<StressPoint> to = {{{1.01e5, 1e3}, 1.0, 0}};
    EXPECT_NEAR(carried_over(from, stress, to)[0], 2.0, 1e-9);
}

TEST(StressPoints, TheNearestIsTheNearest) {
    const std::vector<StressPoint> from = points();
    const fem::NearestPoint nearest(from);
    for (std::size_t k = 0; k < from.size(); ++k)
        EXPECT_EQ(nearest(from[k].place + Vector{0.1, -0.1}), k);
    EXPECT_EQ(nearest({-100.0, 0.2}), 0u);
    EXPECT_EQ(nearest({100.0, 1.0}), from.size() - 1);
}

} // namespace

} // namespace listric::relaxation_test
