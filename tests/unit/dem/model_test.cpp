// A model of the C++ interface has the events that it asks for, and what it cannot do is refused in
// every build, with the member that is to be changed.

#include "dem/events/stage_change.hpp"
#include "dem/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace listric::model_test {

using namespace dem;
namespace {

using testing::HasSubstr;

/// Some 70 discs.
Model small() {
    return {
        .hanging_wall = {.length = 4e3, .thickness = 1500.0, .mean_radius = 150.0},
        .detachment = {.segments = {arc_to_dip(0.0, 1500.0), straight(6e3)}},
        .distance = 20.0,
    };
}

std::string refusal(const Model& model) {
    try {
        make_simulation(model);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Model, StagesChangeWhatTheySay) {
    Model model = small();
    EXPECT_EQ(make_simulation(model).find<StageChange>(), nullptr);
    model.motion.stages = {{.end = Travel(5.0), .speed = 1.0},
                           {.start = Travel(5.0),
                            .end = Travel(20.0),
                            .start_position = Extension(5.0),
                            .speed = 1.0,
                            .sediment_friction = 0.9}};
    Simulation simulation = make_simulation(model);
    simulation.begin(make_hanging_wall(model));
    simulation.extend_to(8.0);
    EXPECT_EQ(std::as_const(simulation).state().materials[sediment].friction, 0.9);
}

TEST(Model, EffectsThatNeedOthers) {
    Model healing = small();
    healing.bond_healing.emplace();
    EXPECT_EQ(refusal(healing), "accepted");
    healing.bonds.reset();
    EXPECT_THAT(refusal(healing), HasSubstr("Model::bond_healing needs Model::bonds"));
    Model compacting = small();
    compacting.compaction.emplace();
    EXPECT_THAT(refusal(compacting), HasSubstr("Model::compaction needs Model::sedimentation"));
    compacting.sedimentation.emplace();
    EXPECT_EQ(refusal(compacting), "accepted");
}

TEST(Model, GroundBehindTheBreakawayHoldsNoSedimentAboveZero) {
    Model model = small();
    model.sedimentation.emplace().level = 100.0;
    EXPECT_EQ(refusal(model), "accepted");
    model.detachment.footwall_top = 2e3;
    EXPECT_THAT(refusal(model), HasSubstr("Model::detachment.footwall_top"));
    model.sedimentation->level = 0.0;
    EXPECT_EQ(refusal(model), "accepted");
}

TEST(Model, ABackstopStandsInGenesisWhereThereIsGround) {
    Model model = small();
    const std::uint64_t with_backstop = hash(make_hanging_wall(model));
    model.detachment.footwall_top = 2e3;
    EXPECT_EQ(hash(make_hanging_wall(model)), with_backstop);
}

TEST(Model, ExtendsNoFurtherThanItsBaseIsMadeFor) {
    const Model model = small();
    Simulation simulation = make_simulation(model);
    EXPECT_THROW(simulation.extend_to(1.0), std::logic_error); // there is no state
    simulation.begin(make_hanging_wall(model));
    EXPECT_THROW(simulation.extend_to(21.0), std::invalid_argument);
    EXPECT_TRUE(simulation.extend_to(20.0));
    EXPECT_NEAR(simulation.extension().m, 20.0, simulation.tolerance().m);
}

TEST(Model, NeedsASpeedAndAThread) {
    Model model = small();
    EXPECT_THROW(make_hanging_wall(model, 0), std::invalid_argument);
    EXPECT_THROW(make_hanging_wall(model, -1), std::invalid_argument);
    model.motion.speed = 0.0;
    EXPECT_THAT(refusal(model), HasSubstr("Motion::speed is 0"));
}

} // namespace
} // namespace listric::model_test
