// Pauses that go by steps, on small scenes with every effect: the bits are those of one run however
// it is cut and by however many threads; years are counted by one clock; what is no pause is
// refused.

#include "apps/commands/explain.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "tests/message_of.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace listric::stage_steps_test {

using namespace dem;
namespace {

using namespace support;
using testing::AllOf;
using testing::HasSubstr;

class Steps : public SceneRuns {
protected:
    static std::string text(const std::string& stages) {
        std::string scene = contents(test_scene("every-effect.toml"));
        const std::string distance = "distance_m = 200.0\n";
        scene.erase(scene.find(distance), distance.size());
        const std::string detachment = "[detachment]\n";
        scene.insert(scene.find(detachment) + detachment.size(), "footwall_top_m = 2000.0\n");
        return scene + stages;
    }

    std::string refusal(const std::string& stages) const {
        return message_of<SceneError>([&] { load(text(stages)); }, "");
    }

    State last_state(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back()).state;
    }
};

/// Ages by stratum, a.
std::map<int, double> ages(const Scene& scene, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::map<int, double> all;
    for (std::size_t i = 0; i < d.stratum.size(); ++i)
        if (d.stratum[i] > 0)
            all[d.stratum[i]] = make_calendar(scene).age(Travel(d.start_travel[i]));
    return all;
}

/// A pause between, whose last step is as long as the others though step_a does not divide it, and
/// the way back.
constexpr const char* there_and_back = "[[stage]]\ndistance_m = 80.0\n"
                                       "[[stage]]\npause_a = 40e6\nstep_a = 15e6\nsettle_m = 60.0\n"
                                       "[[stage]]\ndistance_m = -40.0\n";

TEST_F(Steps, AreOneRunHoweverTheyAreCut) {
    const Scene scene = load(text(there_and_back));
    EXPECT_EQ(scene.extension.distance, 80.0 + 3 * 60.0 + 40.0);
    EXPECT_DOUBLE_EQ(end_age(scene), 40e6 + 12e3);
    const auto whole = run(scene, "whole");
    EXPECT_NEAR(whole["elapsed_a"].get<double>(), 40.012e6, 20.0);
    EXPECT_EQ(whole["steps"], 3);
    EXPECT_LE(whole["unsettled_steps"], 3);
    EXPECT_LT(whole["mass_error_fraction"].get<double>(), 1e-12);
    EXPECT_TRUE(all_finite(last_state("whole").discs));

    RunOptions plain = options("plain");
    plain.plain = true;
    EXPECT_EQ(run(scene, plain)["state_hash"], whole["state_hash"]) << "plain cycle";
    EXPECT_EQ(run(scene, "two", {}, false, 2)["state_hash"], whole["state_hash"]) << "threads";
    run(scene, "cut", 60.0);
    for (const double until : {83.0, 110.0, 127.0, 140.0, 141.0, 198.0, 259.0, 280.0})
        run(scene, "cut", until, true);
    EXPECT_EQ(run(scene, "cut", {}, true)["state_hash"], whole["state_hash"]) << "resumed";
}

TEST_F(Steps, StrataComeOnceAStepAndKnowTheirAge) {
    const std::string sinks = "sedimentation.target=[{time_a=0.0, points=[[0.0, 0.0]]}, "
                              "{time_a=30e6, points=[[0.0, 0.0], [500.0, 120.0]]}]";
    const Scene scene = load(text("[[stage]]\ndistance_m = 20.0\n[[stage]]\npause_a = 30e6\n"
                                  "step_a = 10e6\nsettle_m = 100.0\n"),
                             {sinks, "sedimentation.interval_a=1000.0"});
    run(scene, "strata");
    const std::map<int, double> all = ages(scene, last_state("strata"));
    // 10 m apart before the pause, then three.
    for (int step = 1; step <= 3; ++step) {
        ASSERT_TRUE(all.contains(2 + step));
        EXPECT_NEAR(all.at(2 + step), 2e3 + step * 10e6, 2e4);
    }
    EXPECT_EQ(all.rbegin()->first, 5);
}

TEST_F(Steps, APauseOfOneStepMayComeFirst) {
    const Scene scene = load(text("[[stage]]\npause_a = 100e6\nstep_a = 100e6\n"
                                  "[[stage]]\ndistance_m = 40.0\n"));
    const auto summary = run(scene, "first");
    EXPECT_EQ(summary["steps"], 1);
    EXPECT_NEAR(summary["travel_m"].get<double>(), usual_settling + 40.0, 0.1);
    EXPECT_NEAR(summary["elapsed_a"].get<double>(), 100.004e6, 20.0);
    EXPECT_TRUE(all_finite(last_state("first").discs));
}

TEST_F(Steps, ExplainTellsYearsStepsTravelAndPrice) {
    const auto of = [&](const char* pause) {
        return explain(
            load(text(fmt::format("[[stage]]\ndistance_m = 100.0\n[[stage]]\n{}", pause)),
                 {"extension.speed_m_per_s=1.0"}),
            1, program_effects());
    };
    EXPECT_THAT(of("pause_a = 60e6\nstep_a = 1e6\n"),
                AllOf(HasSubstr("to 12.1 km of travel: pause, 60 Myr, 12 km of travel, 99 % of"),
                      HasSubstr("60 steps of 1 Myr, 200 m or 200 s of the model each"),
                      HasSubstr("60.01 Myr")));
    EXPECT_THAT(of("pause_a = 60e6\n"),
                AllOf(HasSubstr("600 km of travel"), HasSubstr("step_a = 1e6 it takes 12 km")));
    EXPECT_THAT(of("pause_a = 60e4\n"), testing::Not(HasSubstr("step_a")));
}

TEST_F(Steps, WhatIsNoPauseHasNone) {
    EXPECT_EQ(refusal("[[stage]]\npause_a = 300e6\nstep_a = 1e6\n"), "");
    EXPECT_THAT(refusal("[[stage]]\npause_a = 301e6\nstep_a = 1e6\n"), HasSubstr("3e"));
    EXPECT_THAT(refusal("[[stage]]\ndistance_m = 10.0\nstep_a = 1e6\n"),
                AllOf(HasSubstr("stage[0].step_a"), HasSubstr("give pause_a")));
    EXPECT_THAT(refusal("[[stage]]\npause_a = 1e6\nsettle_m = 100.0\n"),
                AllOf(HasSubstr("stage[0].settle_m"), HasSubstr("step_a")));
    EXPECT_THAT(refusal("[[stage]]\npause_a = 1e6\nstep_a = 1e5\nsettle_m = 40.0\n"),
                AllOf(HasSubstr("settle_m"), HasSubstr("50")));
}

} // namespace
} // namespace listric::stage_steps_test
