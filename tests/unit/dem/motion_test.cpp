// The prescribed motion: without stages its position is the travel, bit by bit; with them wall,
// conveyor and friction follow from the travel alone.

#include "dem/base.hpp"
#include "dem/base/contact.hpp"
#include "dem/genesis/detachment.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::motion_test {

using namespace dem;
namespace {

/// 500 m out at 2 m/s, a pause of 100 m of travel, 200 m back at half the rate and 1 m/s.
Motion there_and_back() {
    Motion motion{2.0, 0.0};
    motion.stages = {
        {.start = Travel(0.0),
         .end = Travel(500.0),
         .start_position = Extension(0.0),
         .slope = 1.0,
         .speed = 2.0},
        {.start = Travel(500.0),
         .end = Travel(600.0),
         .start_position = Extension(500.0),
         .slope = 0.0,
         .speed = 2.0,
         .surface = SurfaceWork::fill},
        {.start = Travel(600.0),
         .end = Travel(1000.0),
         .start_position = Extension(500.0),
         .slope = -0.5,
         .speed = 2.0,
         .runs_from = runs_nowhere,
         .detachment_friction = 0.1,
         .surface = SurfaceWork::none},
    };
    return motion;
}

TEST(Motion, WithoutStagesIsTheTravel) {
    const Motion motion{1.25, 24.0};
    for (const double travel : {0.0, 0.1, 1.0 / 3.0, 9999.9})
        EXPECT_EQ(motion.position(Travel(travel)).m, travel);
    for (const double time : {0.0, 7.0, 24.0, 1e4}) {
        const MotionInstant now = motion.at(time, Travel(123.4));
        EXPECT_EQ(now.travel_speed, motion.speed_at(time));
        EXPECT_EQ(now.speed, motion.speed_at(time));
        EXPECT_EQ(now.runs_from, runs_everywhere);
        EXPECT_FALSE(now.friction);
    }
    EXPECT_FALSE(motion.shortens(Travel(500.0)));
    EXPECT_EQ(motion.surface_work(Travel(0.0), Travel(500.0)), SurfaceWork::both);
}

TEST(Motion, StagesSayWhereTheWallIs) {
    const Motion motion = there_and_back();
    EXPECT_EQ(motion.position(Travel(123.25)).m, 123.25);
    EXPECT_EQ(motion.position(Travel(500.0)).m, 500.0);
    EXPECT_EQ(motion.position(Travel(560.0)).m, 500.0);
    EXPECT_EQ(motion.position(Travel(800.0)).m, 400.0);
    EXPECT_EQ(motion.position(Travel(1000.0)).m, 300.0);
    EXPECT_EQ(motion.greatest_position(Travel(1000.0)).m, 500.0);
    EXPECT_EQ(motion.stage(Travel(499.9)), 0u);
    EXPECT_EQ(motion.stage(Travel(500.0)), 1u);
    EXPECT_EQ(motion.stage(Travel(2000.0)), 2u);
    EXPECT_FALSE(motion.shortens(Travel(550.0))); // a pause after extension
    EXPECT_TRUE(motion.shortens(Travel(600.0)));
    EXPECT_EQ(motion.surface_work(Travel(450.0), Travel(500.0)), SurfaceWork::both);
    EXPECT_EQ(motion.surface_work(Travel(500.0), Travel(550.0)), SurfaceWork::fill);
    EXPECT_EQ(motion.surface_work(Travel(600.0), Travel(650.0)), SurfaceWork::none);
}

TEST(Motion, StagesSayHowWallBaseAndFrictionAre) {
    const Motion motion = there_and_back();
    const MotionInstant out = motion.at(100.0, Travel(250.0)),
                        rest = motion.at(100.0, Travel(550.0)),
                        back = motion.at(100.0, Travel(800.0));
    EXPECT_EQ(out.speed, 2.0);
    EXPECT_EQ(rest.speed, 0.0);
    EXPECT_EQ(rest.travel_speed, 2.0); // the clock goes on
    EXPECT_EQ(back.speed, -1.0);
    EXPECT_EQ(back.runs_from, runs_nowhere);
    EXPECT_EQ(back.friction, 0.1);

    const Surface detachment{.name = "", .chain = {}, .friction = 0.5, .conveyor = 1.0},
        wall{.name = "", .chain = {}, .friction = 0.0, .translation = {1.0, 0.0}};
    const BaseInstant now = base_instant(back, 400.0);
    EXPECT_EQ(friction_of(detachment, now), 0.1);
    EXPECT_EQ(friction_of(wall, now), 0.0); // it is the detachment's
    EXPECT_EQ(friction_of(detachment, base_instant(out, 250.0)), 0.5);
    EXPECT_EQ(surface_velocity(detachment, now, 0.0, 0.0, {0.0, 1.0}), (Point{0.0, 0.0}));
    EXPECT_EQ(surface_velocity(wall, now, 0.0, 0.0, {-1.0, 0.0}).x, -1.0);
}

TEST(Motion, PassesZeroWithAConstantAcceleration) {
    // Within 20 m of a change v^2 = 2 a s: by steps as the cycle's, the change takes twice the time
    // that it would take at full speed, and no step changes the wall's speed by more than 2 %.
    Motion motion{1.0, 0.0};
    motion.stages = {{.end = Travel(100.0), .speed = 1.0},
                     {.start = Travel(100.0),
                      .end = Travel(200.0),
                      .start_position = Extension(100.0),
                      .slope = -1.0,
                      .speed = 1.0}};
    const double step = 0.01;
    double travel = 60.0, time = 0.0, before = 1.0, greatest_change = 0.0, least = 1.0;
    while (travel < 140.0) {
        // Also on the way down and up again; the standstill itself lasts some seconds less.
        EXPECT_NEAR(motion.time_at(Travel(travel)) - motion.time_at(Travel(60.0)), time, 1.0)
            << travel;
        const MotionInstant now = motion.at(time, Travel(travel));
        greatest_change = std::max(greatest_change, std::abs(now.speed - before));
        least = std::min(least, now.travel_speed);
        before = now.speed;
        travel += now.travel_speed * step;
        time += step;
    }
    EXPECT_LE(greatest_change, 0.021);
    EXPECT_GT(least, 0.009);
    EXPECT_EQ(before, -1.0);
    EXPECT_NEAR(time, 20.0 + 40.0 + 40.0 + 20.0, 0.01 * 120.0);
    EXPECT_NEAR(motion.time_at(Travel(140.0)) - motion.time_at(Travel(60.0)), time, 0.01 * time);
}

TEST(Motion, TheBaseRunsWhereItsKindSays) {
    // 30 degrees down to a flat at 3 km.
    DetachmentParameters detachment;
    detachment.start_dip = 30.0;
    detachment.segments = {straight(6e3), straight(20e3, 0.0)};
    const Chain chain = detachment_chain(detachment, 0.0);
    const double soles_out = 6e3 * std::cos(pi / 6.0);
    EXPECT_NEAR(sole_out(chain), soles_out, 1e-9);
    EXPECT_EQ(runs_from(BaseKind::sheet, detachment), runs_everywhere);
    EXPECT_EQ(runs_from(BaseKind::rests, detachment), runs_nowhere);
    EXPECT_EQ(runs_from(BaseKind::ramp, detachment), sole_out(chain));

    Motion motion{2.0, 0.0};
    motion.runs_from = sole_out(chain);
    const Surface slides{.name = "", .chain = chain, .conveyor = 1.0};
    const BaseInstant now = base_instant(motion.at(1.0, Travel(2.0)), 2.0);
    // Slip of a disc at rest, 100 m over the ramp and over the flat: over the flat as the base
    // runs.
    const auto slip = [&](Point p) {
        return base_contact_motion(slides, now, {p.x, p.y, 0.0, 0.0, 0.0, 150.0})->slip_rate;
    };
    const double s = std::sin(pi / 6.0), c = std::cos(pi / 6.0);
    EXPECT_EQ(slip({3e3 * c + 100.0 * s, -3e3 * s + 100.0 * c}), 0.0);
    EXPECT_EQ(slip({8e3, -2900.0}), 2.0);
    // Over the end of the ramp a disc stands beyond it and rests on it all the same.
    const double steep = 80.0 * pi / 180.0; // between the half of the corner's 150 degrees and 90
    EXPECT_EQ(slip({soles_out + 105.0 * std::cos(steep), -3e3 + 105.0 * std::sin(steep)}), 0.0);
}

TEST(Motion, AChainSolesOutWhereItStaysLevel) {
    EXPECT_EQ(sole_out({}), 0.0);
    EXPECT_EQ(sole_out({line({0.0, -5.0}, {9.0, -5.0})}), 0.0);
    EXPECT_NEAR(sole_out(support::listric_chain(15e3, 40e3)), 15e3, 1e-9);
    EXPECT_NEAR(sole_out({arc({0.0, 0.0}, {0.0, -1.0}, 7e3, 0.5 * pi)}), 7e3, 1e-9); // at its end
    // Not at the flat between two ramps.
    EXPECT_EQ(sole_out({line({0.0, 0.0}, {1.0, -1.0}), line({1.0, -1.0}, {3.0, -1.0}),
                        line({3.0, -1.0}, {4.0, -3.0}), line({4.0, -3.0}, {6.0, -3.0}),
                        line({6.0, -3.0}, {9.0, -3.0})}),
              4.0);
}

TEST(Motion, TheFootwallsTopRestsAndHoldsTheCorner) {
    DetachmentParameters detachment;
    detachment.segments = {arc_to_dip(0.0, 15e3)};
    detachment.footwall_top = 2e3;
    RigidBase base = make_halfgraben(detachment, {.length = 40e3, .thickness = 15e3}, {}, {1.0});
    const Surface &slides = base.surfaces[0], &top = base.surfaces[1];
    EXPECT_EQ(top.name, "footwall top");
    EXPECT_EQ(top.conveyor, 0.0);
    // Every place above ground is nearest to one of the two, the corner's to the top alone.
    const auto distance = [](const Surface& surface, Point p) {
        const auto foot = nearest(surface, 0.0, p);
        return foot ? foot->distance : -1.0;
    };
    EXPECT_NEAR(distance(top, {-500.0, 100.0}), 100.0, 1e-9);
    EXPECT_EQ(distance(slides, {-500.0, 100.0}), -1.0);
    EXPECT_NEAR(distance(top, {30.0, 40.0}), 50.0, 1e-5);
    EXPECT_EQ(distance(slides, {30.0, 40.0}), -1.0);
    EXPECT_EQ(distance(top, {60.0, -10.0}), -1.0);
    EXPECT_NEAR(distance(slides, {60.0, -10.0}), 60.0, 0.1);
    EXPECT_EQ(distance(top, {-2100.0, 100.0}), -1.0); // beyond its end
    stand_backstop(base);
    EXPECT_EQ(base.surfaces[1].name, "backstop");
    EXPECT_NEAR(distance(base.surfaces[1], {60.0, 10.0}), 60.0, 1e-9);
}

} // namespace
} // namespace listric::motion_test
