// What of the base moves with the right wall, by name: on a small scene, however it is run; as a
// stage says otherwise; in words.

#include "apps/commands/explain.hpp"
#include "apps/scene/base_words.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "tests/message_of.hpp"
#include "tests/places.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

namespace listric::bases_test {

using namespace dem;
namespace {

using namespace support;
using testing::HasSubstr;

class Bases : public SceneRuns {
protected:
    /// Some 370 discs on a quarter circle of 1.5 km and its flat.
    Scene scene(const std::string& base, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> set = more;
        set.push_back("detachment.base=" + base);
        set.emplace_back("extension.distance_m=100.0");
        return load(contents(test_scene("every-effect.toml")), set);
    }
};

TEST_F(Bases, ARampIsOneRunHoweverItIsCut) {
    const Scene ramp = scene("ramp");
    const auto whole = run(ramp, "whole");
    RunOptions plain = options("plain");
    plain.plain = true;
    EXPECT_EQ(run(ramp, plain)["state_hash"], whole["state_hash"]) << "plain cycle";
    EXPECT_EQ(run(ramp, "two", {}, false, 2)["state_hash"], whole["state_hash"]) << "threads";
    run(ramp, "cut", 40.0);
    EXPECT_EQ(run(ramp, "cut", {}, true)["state_hash"], whole["state_hash"]) << "resumed";
    EXPECT_NE(run(scene("sheet"), "sheet")["state_hash"], whole["state_hash"]);
    EXPECT_NE(run(scene("rests"), "rests")["state_hash"], whole["state_hash"]);
}

TEST_F(Bases, WhatRestsHoldsAndWhatMovesPulls) {
    const auto sheet = run(scene("sheet"), "sheet"), rests = run(scene("rests"), "rests"),
               ramp = run(scene("ramp"), "ramp");
    EXPECT_LT(ramp["ramp_mobilised_friction"].get<double>(), 0.0);
    EXPECT_LT(rests["ramp_mobilised_friction"].get<double>(), 0.0);
    EXPECT_GT(sheet["ramp_mobilised_friction"].get<double>(),
              ramp["ramp_mobilised_friction"].get<double>());
    for (const auto& summary : {sheet, rests, ramp}) {
        EXPECT_GT(summary["wall_force_n_per_m"].get<double>(), 0.0);
        EXPECT_LE(std::abs(summary["flat_mobilised_friction"].get<double>()), 0.5);
        EXPECT_FALSE(summary.contains("left_wall_force_n_per_m"));
    }
}

TEST_F(Bases, AStageHasThatOfTheDetachmentOrItsOwn) {
    std::string text = contents(test_scene("every-effect.toml"));
    const std::string distance = "distance_m = 200.0\n", stage = "[[stage]]\ndistance_m = 50.0\n";
    text.erase(text.find(distance), distance.size());
    text += stage + stage + "base = \"rests\"\n" + stage + "base = \"moves\"\n"; // as it was called
    const Scene scene = load(text, {"detachment.base=ramp"});
    const Motion motion = make_motion(scene);
    EXPECT_NEAR(motion.stages[0].runs_from, 1500.0, 1e-6);
    EXPECT_EQ(motion.stages[1].runs_from, runs_nowhere);
    EXPECT_EQ(motion.stages[2].runs_from, runs_everywhere);
    // What a run writes down stands alone.
    const Scene again = load(to_toml(scene));
    EXPECT_EQ(to_toml(again), to_toml(scene));
    EXPECT_THAT(to_toml(scene), HasSubstr("base = \"sheet\""));
    EXPECT_THAT(message_of<SceneError>([&] { load(text, {"stage.1.base=rest"}); }),
                HasSubstr("rests"));
}

// Below 0.23 a wedge of sand slides whole down 20 degrees, above it yields inside. Coarse, at 400
// m, five seeds: slip of 0.85 to 0.92 of the wall's with a friction of 0.1, 0.03 to 0.07 with 0.35.
TEST_F(Bases, SandSlidesDownARampBelowItsFrictionsLimit) {
    const auto slides = [&](const std::string& friction) {
        const Scene sand =
            load_scene({.scene = "sand-ramp",
                        .set = {"hanging_wall.mean_radius_m=640.0", "extension.distance_m=400.0",
                                "detachment.friction=" + friction}});
        return run(sand, "sand" + friction);
    };
    const auto weak = slides("0.1"), strong = slides("0.35");
    EXPECT_GT(weak["ramp_slip_ratio"].get<double>(), 0.7);
    EXPECT_LT(strong["ramp_slip_ratio"].get<double>(), 0.2);
    // The one has all of its friction, the other what holds the wedge, about the limit.
    EXPECT_NEAR(weak["ramp_mobilised_friction"].get<double>(), -0.1, 0.005);
    EXPECT_NEAR(strong["ramp_mobilised_friction"].get<double>(), -0.23, 0.07);
}

TEST_F(Bases, ElasticBasesHaveARampToo) {
    const Scene ramp = load_scene({.scene = "lis1-elastic", .set = {"detachment.base=ramp"}});
    EXPECT_NEAR(make_rigid_base(ramp).motion.runs_from, 15e3, 1e-6);
}

TEST_F(Bases, EveryShippedSceneSaysItsOwnInWords) {
    for (const auto& [name, description] : list_scenes()) {
        const Scene shipped = load_scene({.scene = name});
        const std::string words = base_words(shipped);
        EXPECT_THAT(words, HasSubstr(name == "sand-ramp"    ? "ramp: the footwall is at rest"
                                     : name == "sand-wedge" ? "rests: the footwall is at rest"
                                     : shipped.detachment   ? "sheet: the whole detachment moves"
                                     : name == "basement-fault" ? "fault of the basement dips"
                                                                : "stretches uniformly"))
            << name;
        EXPECT_THAT(explain(shipped, CycleSpeed{1e8, 1e8, 1.0}, 1, program_effects()),
                    HasSubstr("base\n  " + words))
            << name;
    }
    EXPECT_THAT(base_words(scene("ramp")), HasSubstr("sole-out point at x = 1.5 km"));
    EXPECT_THAT(base_words(scene("rests")), HasSubstr("resists along the whole detachment"));
}

} // namespace
} // namespace listric::bases_test
