// Closest points on chains of lines and arcs. On LIS1's quarter circle of radius R about C a point
// C + rho (cos a, sin a) lies R - rho from the chain. Lengths are up to 4e4 m and a handful of
// operations are rounded, so 1e-9 m leaves a margin of a hundred.

#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::base_test {

using namespace dem;
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

TEST(Base, BeyondAConcaveCornerIsOutside) {
    // Down at 60 degrees, then on at 30: the footwall's corner points away from the material.
    const Point t{0.5, -0.5 * std::sqrt(3.0)}, u{0.5 * std::sqrt(3.0), -0.5};
    const Point kink{t.x, t.y};
    const Chain chain{line({0.0, 0.0}, kink), line(kink, {kink.x + u.x, kink.y + u.y})};
    const Point out{-std::sin(pi / 4.0), -std::cos(pi / 4.0)}; // along the bisector
    const auto foot = foot_point(chain, {kink.x + 2.0 * out.x, kink.y + 2.0 * out.y});
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, -2.0, 1e-14);
    EXPECT_NEAR(foot->normal.x, -out.x, 1e-14);
    EXPECT_NEAR(foot->normal.y, -out.y, 1e-14);
    EXPECT_NEAR(foot->arc_length, 1.0, 1e-14);
}

TEST(Base, SignOfTheDistanceTellsTheSideOfAnyChain) {
    // Convex and concave kinks, an arc that steepens and one that flattens: the distance is
    // positive exactly above the chain, and going by it along the normal leads onto the chain.
    const double degree = pi / 180.0;
    Chain chain;
    Point at{0.0, 0.0};
    const auto direction = [&](double dip) {
        return Point{std::cos(dip * degree), -std::sin(dip * degree)};
    };
    const auto add_line = [&](double dip, double length) {
        const Point t = direction(dip);
        chain.push_back(line(at, {at.x + length * t.x, at.y + length * t.y}));
        at = chain.back().end;
    };
    const auto add_arc = [&](double from, double to, double radius) {
        chain.push_back(arc(at, direction(from), radius, (from - to) * degree));
        at = chain.back().end;
    };
    add_line(70.0, 3.0);
    add_line(20.0, 4.0);     // concave
    add_line(80.0, 2.0);     // convex
    add_arc(50.0, 0.0, 3.0); // concave, then flattens
    add_arc(0.0, 60.0, 1.0); // steepens
    add_line(0.0, 8.0);      // concave
    double length = 0.0;
    for (const Segment& s : chain)
        length += s.length;
    support::Random random(3);
    for (int k = 0; k < 2000; ++k) {
        const Point p{random.between(0.5, at.x - 6.0), random.between(at.y - 2.0, 0.0)};
        double low = 0.0, high = length;
        for (int n = 0; n < 60; ++n)
            (point_at(chain, 0.5 * (low + high)).x < p.x ? low : high) = 0.5 * (low + high);
        const double height = p.y - point_at(chain, low).y;
        const auto foot = foot_point(chain, p);
        ASSERT_TRUE(foot) << p.x << " " << p.y;
        EXPECT_EQ(foot->distance > 0.0, height > 0.0) << p.x << " " << p.y;
        EXPECT_LE(std::abs(foot->distance), std::abs(height) + 1e-12);
        const Point on = point_at(chain, foot->arc_length);
        EXPECT_NEAR(p.x - foot->distance * foot->normal.x, on.x, 1e-12);
        EXPECT_NEAR(p.y - foot->distance * foot->normal.y, on.y, 1e-12);
    }
}

TEST(Base, OpenEndsHaveNoFoot) {
    const Chain chain = listric_chain(R, 40e3);
    EXPECT_FALSE(foot_point(chain, {100.0, 1.0}));         // above the breakaway
    EXPECT_FALSE(foot_point(chain, {R + 40e3 + 1.0, -R})); // beyond the flat
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
} // namespace listric::base_test
