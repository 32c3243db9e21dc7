// Where a dropped disc comes to rest. Ground finds the place to 1e-6 m along x and heights over
// the base to 1e-7 m; slopes in the pockets below are at most a few, so gaps stay below 1e-5 radii
// and nothing overlaps by more than 1e-6 radii = 1e-4 m.

#include "dem/base/ground.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace listric::ground_test {

using namespace dem;
namespace {

using namespace support;

double gap(Point p, double radius, const Disc& disc) {
    return std::hypot(p.x - disc.x, p.y - disc.y) - radius - disc.radius;
}

TEST(Ground, DiscRestsInThePocketBetweenTwo) {
    const RigidBase base = box(4000.0, 1e5);
    for (double right_radius : {70.0, 100.0, 120.0}) {
        const std::vector<Disc> two{{1900.0, 100.0, 100.0}, {2120.0, right_radius, right_radius}};
        const State state = make_state(two);
        const Ground ground(state, base, 120.0);
        for (double x : {1950.0, 2000.0, 2050.0, 2090.0}) {
            const auto place = ground.rest(x, 80.0);
            ASSERT_TRUE(place) << x;
            EXPECT_NEAR(gap(*place, 80.0, two[0]), 0.0, 1e-5 * 80.0) << x;
            EXPECT_NEAR(gap(*place, 80.0, two[1]), 0.0, 1e-5 * 80.0) << x;
            EXPECT_GT(place->y, 100.0);
        }
    }
}

TEST(Ground, DiscRestsBetweenDetachmentAndDisc) {
    constexpr double R = 15e3;
    const RigidBase base = listric_base(R, 40e3);
    // A disc on the arc, 30 degrees below its centre's level.
    const double slope = pi / 6.0, r = 100.0;
    const Disc on_arc{R - (R - r) * std::cos(slope), -(R - r) * std::sin(slope), r};
    const State state = make_state({on_arc});
    const Ground ground(state, base, 120.0);
    const auto place = ground.rest(on_arc.x - 150.0, 80.0);
    ASSERT_TRUE(place);
    EXPECT_LT(place->x, on_arc.x);
    EXPECT_NEAR(gap(*place, 80.0, on_arc), 0.0, 1e-5 * 80.0);
    const auto foot = foot_point(base.surfaces[0].chain, *place);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, 80.0, 1e-5 * 80.0);
}

TEST(Ground, HeightOverTheBaseAlone) {
    constexpr double R = 15e3;
    const RigidBase base = listric_base(R, 40e3);
    const State state = make_state({{20e3, -R + 100.0, 100.0}});
    const Ground ground(state, base, 100.0);
    // The centre of a disc on the arc is on the circle of radius R - r.
    for (double x : {1000.0, 5000.0, 14000.0}) {
        const double expected = -std::sqrt(std::pow(R - 90.0, 2) - std::pow(R - x, 2));
        EXPECT_NEAR(ground.height(x, 90.0), expected, 1e-6) << x;
    }
    EXPECT_NEAR(ground.height(30e3, 90.0), -R + 90.0, 1e-6);
    EXPECT_NEAR(ground.height(20e3, 90.0), -R + 290.0, 1e-6);
}

TEST(Ground, NothingRestsOutsideTheBase) {
    const RigidBase base = listric_base(15e3, 40e3);
    const State state = make_state({{20e3, -15e3 + 100.0, 100.0}});
    const Ground ground(state, base, 100.0);
    for (double x : {-500.0, 50.0, 39.95e3, 41e3}) { // beyond or within a radius of a wall
        EXPECT_EQ(ground.height(x, 90.0), std::numeric_limits<double>::infinity()) << x;
        EXPECT_FALSE(ground.rest(x, 90.0)) << x;
    }
}

TEST(Ground, NothingFallsBehindAnInclinedBreakaway) {
    // Behind the breakaway a gap opens between the backstop's end and the detachment's normal.
    for (double dip : {85.0, 60.0, 30.0}) {
        const double a = dip * pi / 180.0;
        RigidBase base = listric_base(15e3, 40e3);
        base.surfaces[0].chain = {
            line({0.0, 0.0}, {8e3 * std::cos(a), -8e3 * std::sin(a)}),
            line({8e3 * std::cos(a), -8e3 * std::sin(a)}, {80e3, -8e3 * std::sin(a)})};
        const Disc first{200.0, 200.0 * std::tan(-a) + 100.0 / std::cos(a), 100.0};
        const State state = make_state({first});
        const Ground ground(state, base, 120.0);
        for (double x = -400.0; x < 3e3; x += 7.0) {
            const double height = ground.height(x, 90.0);
            if (x < 90.0 * std::sin(a)) {
                EXPECT_EQ(height, std::numeric_limits<double>::infinity()) << dip << " " << x;
                continue;
            }
            const auto place = ground.rest(x, 90.0);
            if (place) {
                EXPECT_GE(place->x, 90.0 * std::sin(a) - 1e-6) << dip << " " << x;
                EXPECT_GE(place->y, -8e3 * std::sin(a) + 90.0 - 1e-6) << dip << " " << x;
            }
        }
    }
}

TEST(Ground, WallMovesWithTheExtension) {
    const RigidBase base = listric_base(15e3, 40e3);
    State state = make_state({{39.5e3, -15e3 + 100.0, 100.0}});
    EXPECT_GT(Ground(state, base, 100.0).height(40.2e3, 90.0), 1e4); // the wall, not the ground
    state.clock.travel.m = state.clock.extension.m = 500.0;
    EXPECT_NEAR(Ground(state, base, 100.0).height(40.2e3, 90.0), -15e3 + 90.0, 1e-6);
}

TEST(Ground, FillNeitherOverlapsNorSinks) {
    constexpr double R = 15e3;
    const RigidBase base = listric_base(R, 40e3);
    std::vector<Disc> discs;
    for (double slope : {0.25, 0.5 * pi}) // the ends of a stretch of the detachment
        discs.push_back({R - (R - 100.0) * std::cos(slope), -(R - 100.0) * std::sin(slope), 100.0});
    const State state = make_state(discs);
    Ground ground(state, base, 120.0);
    Random random(5);
    std::size_t held_twice = 0;
    for (int dropped = 0; dropped < 500; ++dropped) {
        const double radius = random.between(70.0, 120.0);
        // Narrow enough for the discs to pile up.
        const auto place = ground.rest(random.between(9e3, 13e3), radius);
        ASSERT_TRUE(place);
        const auto foot = foot_point(base.surfaces[0].chain, *place);
        ASSERT_TRUE(foot);
        EXPECT_GE(foot->distance, radius * (1.0 - 1e-6));
        int held_by = foot->distance < radius * (1.0 + 1e-5);
        for (const Disc& other : discs) {
            const double distance = gap(*place, radius, other);
            EXPECT_GE(distance, -1e-6 * radius);
            held_by += distance < 1e-5 * radius;
        }
        EXPECT_GE(held_by, 1);
        held_twice += held_by >= 2;
        ground.add(*place, radius);
        discs.push_back({place->x, place->y, radius});
    }
    // Discs fall along vertical lines: at the foot of an overhang they are held by one alone.
    EXPECT_GE(held_twice, 440u);
    const auto top = std::ranges::max(discs, {}, &Disc::y);
    EXPECT_GT(top.y, -R + 1000.0); // it is a pile, not a layer
}

TEST(Ground, NoDiscHangsOnTheSideOfAnother) {
    // Heights jump where a disc passes another at its equator: rest is on the lower side.
    const RigidBase base = listric_base(15e3, 40e3);
    const State state = make_state({{14e3, -15e3 + 160.0, 100.0}, {15e3, -15e3 + 100.0, 100.0}});
    Ground ground(state, base, 120.0);
    Random random(5);
    for (int dropped = 0; dropped < 300; ++dropped) {
        const double radius = random.between(70.0, 120.0);
        const auto place = ground.rest(random.between(10e3, 13e3), radius);
        ASSERT_TRUE(place);
        for (double side : {-2e-6, 2e-6})
            EXPECT_GE(ground.height(place->x + side, radius), place->y - 1e-3)
                << "disc " << dropped << " at x = " << place->x;
        ground.add(*place, radius);
    }
}

TEST(Ground, KnowsWhatDiscsKeepADiscAbove) {
    // A row of touching discs: between two a disc of radius 80 rests at its lowest, 100 +
    // sqrt(180^2
    // - 100^2), over a disc at its highest, 280.
    const RigidBase base = box(4000.0, 1e5);
    std::vector<Disc> row;
    for (int k = 0; k < 20; ++k)
        row.push_back({100.0 + 200.0 * k, 100.0, 100.0});
    const Ground ground(make_state(row), base, 120.0);
    const double pocket = 100.0 + std::sqrt(180.0 * 180.0 - 100.0 * 100.0);
    EXPECT_TRUE(ground.keeps_above(pocket - 1.5, 350.0, 1650.0, 80.0));
    EXPECT_FALSE(ground.keeps_above(pocket + 0.2, 350.0, 1650.0, 80.0));
    EXPECT_TRUE(ground.keeps_above(pocket + 0.2, 480.0, 520.0, 80.0));
    EXPECT_FALSE(ground.keeps_above(280.2, 499.0, 501.0, 80.0));
    for (const double x : {350.0, 412.5, 500.0, 1650.0}) { // as height() has it
        const double height = ground.height(x, 80.0);
        EXPECT_TRUE(ground.keeps_above(height - 0.2, x, x + 1e-3, 80.0));
        EXPECT_FALSE(ground.keeps_above(height + 0.2, x, x + 1e-3, 80.0));
    }
}

} // namespace
} // namespace listric::ground_test
