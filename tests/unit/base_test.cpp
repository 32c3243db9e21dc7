// Closest points on chains of lines and arcs. On LIS1's quarter circle of radius R about C a point
// C + rho (cos a, sin a) lies R - rho from the chain. Lengths are up to 4e4 m and a handful of
// operations are rounded, so 1e-9 m leaves a margin of a hundred.

#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric {
namespace {

using namespace support;

constexpr double tolerance = 1e-9;
constexpr double R = 15e3;

TEST(Base, FootOnTheArc) {
    const Chain chain = listric_chain(R, 40e3);
    for (double turn : {0.01, 0.5, 1.0, 1.57})
        for (double distance : {-300.0, 0.0, 1.0, 90.0, 8000.0}) {
            // The material is inside the circle, whose centre is (R, 0).
            const Point out{-std::cos(turn), -std::sin(turn)};
            const double rho = R - distance;
            const auto foot = foot_point(chain, {R + rho * out.x, rho * out.y});
            ASSERT_TRUE(foot) << turn << " " << distance;
            EXPECT_NEAR(foot->distance, distance, tolerance);
            EXPECT_NEAR(foot->arc_length, R * turn, tolerance * R / rho);
            EXPECT_NEAR(foot->normal.x, -out.x, 1e-12);
            EXPECT_NEAR(foot->normal.y, -out.y, 1e-12);
        }
}

TEST(Base, FootOnTheFlat) {
    const Chain chain = listric_chain(R, 40e3);
    for (double x : {R + 1e-3, 20e3, 54e3})
        for (double distance : {-10.0, 0.0, 93.1, 14e3}) {
            const auto foot = foot_point(chain, {x, -R + distance});
            ASSERT_TRUE(foot);
            EXPECT_NEAR(foot->distance, distance, tolerance);
            EXPECT_NEAR(foot->arc_length, 0.5 * pi * R + x - R, tolerance);
            EXPECT_NEAR(foot->normal.x, 0.0, 1e-15);
            EXPECT_NEAR(foot->normal.y, 1.0, 1e-15);
        }
}

TEST(Base, ArcTurningRight) {
    // From (0, 0) along +x, turning right by 90 degrees about (0, -10): the material is outside.
    const Chain chain{arc({0.0, 0.0}, {1.0, 0.0}, 10.0, -0.5 * pi)};
    EXPECT_NEAR(chain[0].end.x, 10.0, tolerance);
    EXPECT_NEAR(chain[0].end.y, -10.0, tolerance);
    const double s = std::sqrt(0.5);
    const auto foot = foot_point(chain, {13.0 * s, 13.0 * s - 10.0});
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, 3.0, tolerance);
    EXPECT_NEAR(foot->arc_length, 10.0 * 0.25 * pi, tolerance);
    EXPECT_NEAR(foot->normal.x, s, 1e-12);
    EXPECT_NEAR(foot->normal.y, s, 1e-12);
}

TEST(Base, TangentialJointHasNeitherGapNorStep) {
    const Chain chain = listric_chain(R, 40e3);
    for (double height : {0.0, 93.1, 5000.0}) {
        double previous = 0.0;
        for (int k = -200; k <= 200; ++k) {
            const double x = R + 1e-8 * k;
            const auto foot = foot_point(chain, {x, -R + height});
            ASSERT_TRUE(foot) << "x - R = " << 1e-8 * k << ", height " << height;
            EXPECT_NEAR(foot->distance, height, tolerance);
            if (k > -200) {
                EXPECT_NEAR(foot->arc_length - previous, 1e-8, 3e-8); // arc: stretched R/(R-h)
            }
            previous = foot->arc_length;
        }
    }
}

TEST(Base, ConvexCornerIsAFoot) {
    // Up a slope of 45 degrees and down again: the corner (1, 1) points into the material above.
    const Chain chain{line({0.0, 0.0}, {1.0, 1.0}), line({1.0, 1.0}, {2.0, 0.0})};
    const auto above = foot_point(chain, {1.3, 3.0});
    ASSERT_TRUE(above);
    EXPECT_NEAR(above->distance, std::hypot(0.3, 2.0), 1e-14);
    EXPECT_NEAR(above->arc_length, std::sqrt(2.0), 1e-14);
    EXPECT_NEAR(above->normal.x, 0.3 / std::hypot(0.3, 2.0), 1e-14);
    EXPECT_NEAR(above->normal.y, 2.0 / std::hypot(0.3, 2.0), 1e-14);
    const auto slope = foot_point(chain, {0.0, 1.0});
    ASSERT_TRUE(slope);
    EXPECT_NEAR(slope->distance, std::sqrt(0.5), 1e-14);
    EXPECT_NEAR(slope->normal.x, -std::sqrt(0.5), 1e-14);
}

TEST(Base, ConcaveCornerTakesTheNearerSide) {
    const Chain chain{line({0.0, 5.0}, {0.0, 0.0}), line({0.0, 0.0}, {5.0, 0.0})};
    const auto foot = foot_point(chain, {1.0, 2.0});
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, 1.0, 1e-15);
    EXPECT_NEAR(foot->normal.x, 1.0, 1e-15);
}

TEST(Base, OpenEndsHaveNoFoot) {
    const Chain chain = listric_chain(R, 40e3);
    EXPECT_FALSE(foot_point(chain, {100.0, 1.0}));          // above the breakaway
    EXPECT_FALSE(foot_point(chain, {R + 40e3 + 1.0, -R}));  // beyond the flat
    EXPECT_TRUE(foot_point(chain, {100.0, -1.0}));
    EXPECT_TRUE(foot_point(chain, {R + 40e3 - 1.0, -R}));
    EXPECT_FALSE(foot_point({}, {0.0, 0.0}));
}

TEST(Base, FootBelongsToTheArcNotToItsOpposite) {
    // Across the centre of the circle: nearest to the circle's other side, which is no surface.
    const Chain chain{arc({0.0, 0.0}, {0.0, -1.0}, 10.0, 0.5 * pi)};
    EXPECT_FALSE(foot_point(chain, {15.0, 3.0}));
}

TEST(Base, PointAtIsTheInverseOfFoot) {
    const Chain chain = listric_chain(R, 40e3);
    const double length = 0.5 * pi * R + 40e3;
    for (int k = 1; k < 100; ++k) {
        const double s = length * k / 100.0;
        const Point on = point_at(chain, s);
        const auto foot = foot_point(chain, on);
        ASSERT_TRUE(foot) << s;
        EXPECT_NEAR(foot->arc_length, s, tolerance);
        EXPECT_NEAR(foot->distance, 0.0, tolerance);
        const auto off =
            foot_point(chain, {on.x + 500.0 * foot->normal.x, on.y + 500.0 * foot->normal.y});
        ASSERT_TRUE(off) << s;
        EXPECT_NEAR(off->arc_length, s, tolerance);
        EXPECT_NEAR(off->distance, 500.0, tolerance);
    }
    const Point end = point_at(chain, length);
    EXPECT_NEAR(end.x, R + 40e3, tolerance);
    EXPECT_NEAR(end.y, -R, tolerance);
}

TEST(Base, SpeedRampsUpFromRest) {
    const Motion motion{2.0, 10.0};
    EXPECT_DOUBLE_EQ(motion.speed_at(0.0), 0.0);
    EXPECT_DOUBLE_EQ(motion.speed_at(5.0), 1.0);
    EXPECT_DOUBLE_EQ(motion.speed_at(10.0), 2.0);
    EXPECT_DOUBLE_EQ(motion.speed_at(1e3), 2.0);
    EXPECT_DOUBLE_EQ((Motion{2.0, 0.0}).speed_at(0.0), 2.0);
}

} // namespace
} // namespace listric
