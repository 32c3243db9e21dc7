// Changes where a stage begins: sediment gets its friction, discs forget their mean motion.

#include "dem/cycle_physics.hpp"
#include "dem/events/stage_change.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace listric::stage_change_test {

using namespace dem;
namespace {

/// 100 m out, a pause of 50 m of travel, 100 m further with other sediment.
Motion with_a_pause() {
    return {.speed = 1.0,
            .stages = {{.start = Travel(0.0), .end = Travel(100.0), .speed = 1.0},
                       {.start = Travel(100.0), .end = Travel(150.0), .slope = 0.0, .speed = 1.0},
                       {.start = Travel(150.0),
                        .end = Travel(250.0),
                        .start_position = Extension(100.0),
                        .speed = 1.0,
                        .sediment_friction = 0.3}}};
}

/// A disc whose mean motion is known.
State moving() {
    State state = empty_state();
    state.materials.assign(3, Material{});
    add_discs(state, 1);
    add_mean_velocities(state);
    state.discs.get<float>("mean_vx")[0] = 1.0f;
    state.discs.get<float>("mean_vy")[0] = -1.0f;
    return state;
}

TEST(StageChange, DiscsForgetTheirMeanMotionWhereTheWallComesToRest) {
    StageChange event(with_a_pause());
    State state = moving();
    event.begin(state);
    EXPECT_EQ(event.next_due().m, 100.0);
    EXPECT_FALSE(event.apply(state, {}));
    EXPECT_EQ(state.discs.get<float>("mean_vx")[0], 0.0f);
    EXPECT_EQ(state.discs.get<float>("mean_vy")[0], 0.0f);
}

TEST(StageChange, OnlySedimentChangesWhereTheWallGoesOn) {
    StageChange event(with_a_pause());
    State state = moving();
    event.applied = 1;
    EXPECT_EQ(event.next_due().m, 150.0);
    EXPECT_FALSE(event.apply(state, {}));
    EXPECT_EQ(state.materials[sediment].friction, 0.3);
    EXPECT_EQ(state.discs.get<float>("mean_vx")[0], 1.0f);
    event.applied = 2;
    EXPECT_EQ(event.next_due().m, std::numeric_limits<double>::infinity());
}

TEST(StageChange, AMotionThatOnlyReversesNeedsNone) {
    Motion motion = with_a_pause();
    EXPECT_TRUE(StageChange::is_needed(motion));
    motion.stages[1].slope = -1.0;
    motion.stages[2].sediment_friction.reset();
    EXPECT_FALSE(StageChange::is_needed(motion));
    EXPECT_FALSE(StageChange::is_needed({.speed = 1.0}));
}

} // namespace
} // namespace listric::stage_change_test
