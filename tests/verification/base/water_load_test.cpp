// Pressure of water on a base that bends, against what Archimedes says of it.

#include "coupling/water_load.hpp"
#include "dem/numbers/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace listric::water_load_test {

using namespace coupling;

namespace {

constexpr double weight = 1030.0 * 9.81, deep = 15e3, everywhere = 1e9;

/// Nodes of a quarter circle down to 15 km, and of the flat that follows it.
struct Section {
    std::vector<double> x, y, ux, uy;

    Section() {
        constexpr int on_arc = 60;
        for (int k = 0; k <= on_arc; ++k) {
            const double angle = 0.5 * std::numbers::pi * k / on_arc;
            x.push_back(deep * (1.0 - std::cos(angle)));
            y.push_back(-deep * std::sin(angle));
        }
        for (int k = 1; k <= 100; ++k) {
            x.push_back(deep + 25e3 * k / 100.0);
            y.push_back(-deep);
        }
        ux.assign(x.size(), 0.0);
        uy.assign(x.size(), 0.0);
    }

    DeformedTrace trace() const { return {x, y, ux, uy, 2}; }
};

struct Sum {
    double x = 0.0, y = 0.0;
};

Sum sum_of(const std::vector<double>& forces) {
    Sum sum;
    for (std::size_t k = 0; k < forces.size(); k += 2) {
        sum.x += forces[k];
        sum.y += forces[k + 1];
    }
    return sum;
}

TEST(WaterLoad, WeighsAsTheWaterAboveAndPushesAsItsDepth) {
    const Section s;
    const Sum all = sum_of(water_forces(s.trace(), 0.0, weight, everywhere));
    const double area = water_area(s.trace(), 0.0, everywhere);
    // Parabolas through a circle's points cut off 1e-8 of the area; forces of the trace are exact.
    EXPECT_NEAR(area, 0.25 * std::numbers::pi * deep * deep + 25e3 * deep, 1e-7 * area);
    EXPECT_NEAR(-all.y, weight * area, 1e-12 * weight * area);
    EXPECT_NEAR(-all.y, 5.574690e12, 1e-6 * 5.574690e12);
    EXPECT_NEAR(-all.x, 0.5 * weight * deep * deep, 1e-12 * 0.5 * weight * deep * deep);
}

TEST(WaterLoad, FollowsABaseThatRises) {
    Section s;
    const Sum before = sum_of(water_forces(s.trace(), 0.0, weight, everywhere));
    for (std::size_t k = 0; k < s.x.size(); ++k)
        s.uy[k] = 800.0 * std::exp(-s.x[k] / 20e3);
    const Sum after = sum_of(water_forces(s.trace(), 0.0, weight, everywhere));
    const double lighter = after.y - before.y, pushed = after.x - before.x;
    std::printf("upward %.5e, sideways %.4e N/m\n", lighter, pushed);
    // Archimedes: the change of area below the level, and of the depth's square at the end.
    const double end = -deep + s.uy.back();
    EXPECT_NEAR(after.x, -0.5 * weight * end * end, 1e-12 * std::abs(after.x));
    EXPECT_NEAR(-after.y, weight * water_area(s.trace(), 0.0, everywhere),
                1e-12 * std::abs(after.y));
    EXPECT_NEAR(lighter, 1.3973e11, 1e-3 * 1.3973e11);
    EXPECT_NEAR(pushed, 1.6350e10, 1e-3 * 1.6350e10); // not 1.046e11, as if its normal stayed
}

TEST(WaterLoad, EndsAtTheLevelAndAtTheWall) {
    const Section s;
    for (const double level : {-3e3, -7123.4, -14999.0, 500.0}) {
        const Sum all = sum_of(water_forces(s.trace(), level, weight, 32.1e3));
        const double area = water_area(s.trace(), level, 32.1e3);
        EXPECT_NEAR(-all.y, weight * area, 1e-12 * weight * area) << level;
        const double depth = deep + level, top = std::max(0.0, level);
        EXPECT_NEAR(-all.x, 0.5 * weight * (depth * depth - top * top), 1e-9 * weight * 1e8)
            << level;
    }
    EXPECT_EQ(sum_of(water_forces(s.trace(), -deep - 1.0, weight, everywhere)).y, 0.0);
}

/// What a displacement does to forces is symmetric, but at the end, where the trace's last node
/// moves the water's end along.
TEST(WaterLoad, HasASymmetricTangent) {
    Section s;
    for (std::size_t k = 0; k < s.x.size(); ++k) {
        s.ux[k] = 50.0 * std::sin(s.x[k] / 5e3);
        s.uy[k] = 300.0 * std::cos(s.x[k] / 9e3);
    }
    const std::size_t unknowns = 2 * s.x.size() - 2; // without the last node's
    const auto column = [&](std::size_t i) {
        Section up = s, down = s;
        (i % 2 ? up.uy : up.ux)[i / 2] += 10.0;
        (i % 2 ? down.uy : down.ux)[i / 2] -= 10.0;
        std::vector<double> forces = water_forces(up.trace(), 0.0, weight, everywhere);
        const std::vector<double> less = water_forces(down.trace(), 0.0, weight, everywhere);
        for (std::size_t k = 0; k < forces.size(); ++k)
            forces[k] = (forces[k] - less[k]) / 20.0;
        return forces;
    };
    double largest = 0.0, apart = 0.0;
    std::vector<std::vector<double>> tangent;
    for (std::size_t i = 0; i < unknowns; ++i)
        tangent.push_back(column(i));
    for (std::size_t i = 4; i < unknowns; ++i) // the first face crosses the level
        for (std::size_t j = 4; j < unknowns; ++j) {
            largest = std::max(largest, std::abs(tangent[i][j]));
            apart = std::max(apart, std::abs(tangent[i][j] - tangent[j][i]));
        }
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(apart, 1e-6 * largest); // differences of forces of 1e9 N
}

} // namespace
} // namespace listric::water_load_test
