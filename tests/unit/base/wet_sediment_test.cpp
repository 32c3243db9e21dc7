// The ground as the water feels it: where the target line is now, what the next work at the surface
// will be, and what grains that lays down or takes away.

#include "fluid/wet_sediment.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::wet_sediment_test {

using namespace dem;
using namespace fluid;
namespace {

using namespace support;

constexpr double radius = 50.0, rate = 0.01;

/// Level ground at 0.
State level_ground(double travel) {
    std::vector<Disc> discs;
    for (int k = 0; k < 40; ++k)
        discs.push_back({100.0 * k, -radius, radius});
    State state = make_state(discs);
    state.clock.travel = Travel(travel);
    return state;
}

/// A line at that height above what sedimentation leaves free; a stratum every 10,000 a.
WetSediment sediment(Target line) {
    WetSediment s;
    s.surface = std::move(line);
    s.deposition = {1e4, rate};
    return s;
}

Target at(double height) { return Target(height + WetGround::left_free * radius); }

TEST(WetGround, IsTheLineWhereSedimentationWorks) {
    const State state = level_ground(150.0);
    const WetGround filled(state, {}, sediment(at(30.0)));
    EXPECT_NEAR(filled.pending(2000.0), 30.0, 1e-9);
    EXPECT_NEAR(filled.depth({2000.0, -100.0}), 130.0, 1e-9);
    EXPECT_NEAR(filled.grains({2000.0, -100.0}, 60.0), 60.0 + 0.5 * 30.0, 1e-9);
    EXPECT_NEAR(filled.grains({2000.0, 10.0}, 0.0), 0.5 * 20.0, 1e-9); // above the discs' ground
    const WetGround eroded(state, {}, sediment(at(-40.0)));
    EXPECT_NEAR(eroded.grains({2000.0, -100.0}, 50.0), 50.0 * 0.6, 1e-9);
    EXPECT_EQ(eroded.grains({2000.0, -30.0}, 15.0), 0.0);
}

TEST(WetGround, FollowsALineThatMoves) {
    const double free = WetGround::left_free * radius;
    const Target rising(0.0, {{0.0, {{0.0, free}}}, {20000.0, {{0.0, free + 100.0}}}});
    EXPECT_NEAR(WetGround(level_ground(0.0), {}, sediment(rising)).pending(0.0), 0.0, 1e-9);
    EXPECT_NEAR(WetGround(level_ground(50.0), {}, sediment(rising)).pending(0.0), 25.0, 1e-9);
    EXPECT_NEAR(WetGround(level_ground(900.0), {}, sediment(rising)).pending(0.0), 100.0, 1e-9);
}

TEST(WetGround, HasWhatTheStageDoes) {
    Motion motion;
    motion.speed = 1.0;
    const auto stage = [](double start, double end, SurfaceWork work) {
        MotionStage one;
        one.start = Travel(start);
        one.end = Travel(end);
        one.surface = work;
        return one;
    };
    motion.stages = {stage(0.0, 200.0, SurfaceWork::fill), stage(200.0, 400.0, SurfaceWork::erode),
                     stage(400.0, 600.0, SurfaceWork::none)};
    const auto pending = [&](double travel, double height) {
        return WetGround(level_ground(travel), motion, sediment(at(height))).pending(0.0);
    };
    EXPECT_NEAR(pending(150.0, 30.0), 30.0, 1e-9);
    EXPECT_EQ(pending(150.0, -30.0), 0.0);
    EXPECT_NEAR(pending(200.0, 30.0), 30.0, 1e-9); // the stratum that ends the first stage
    EXPECT_EQ(pending(250.0, 30.0), 0.0);
    EXPECT_NEAR(pending(250.0, -30.0), -30.0, 1e-9);
    EXPECT_EQ(pending(500.0, 30.0), 0.0);
    EXPECT_EQ(pending(500.0, -30.0), 0.0);
}

TEST(WetGround, IsTheDiscsWithoutSedimentation) {
    EXPECT_EQ(WetGround(level_ground(150.0), {}, {}).pending(0.0), 0.0);
}

} // namespace
} // namespace listric::wet_sediment_test
