// Water in the pores of all discs on a base that bends: what the base bears, and what a scene must
// not ask of it.

#include "apps/commands/explain.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "tests/message_of.hpp"
#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace listric::fem_water_base_test {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace support;
using testing::AllOf;
using testing::HasSubstr;

/// 400 discs on a crust of 5 km: strata every 12.5 m, and water as often.
const std::string scene = small_halfgraben() + R"([extension]
distance_m = 100.0
speed_m_per_s = 1.0
[output]
interval_m = 25.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
[sedimentation]
level_m = 0.0
interval_a = 2500.0
[compaction]
[pore_fluid]
permeability_m2 = 1e-21
)" + small_elastic_base() +
                          "elastic_thickness_m = 1000.0\n";

class WaterOnABase : public SceneRuns {
protected:
    json run(const std::string& name, const std::vector<std::string>& set = {},
             std::optional<double> until = {}, bool resume = false, int threads = 1) const {
        RunOptions o = options(name);
        o.until = until;
        o.resume = resume;
        o.force = !resume;
        o.threads = threads;
        return SceneRuns::run(SceneRuns::load(scene, set), o);
    }

    std::string refusal(const std::vector<std::string>& set, const std::string& more = "") const {
        return message_of<SceneError>([&] { SceneRuns::load(scene + more, set); });
    }

    State end_of(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back()).state;
    }
};

TEST_F(WaterOnABase, BearsTheWeightOfRockAndWaterHoweverItIsRun) {
    const json once = run("once");
    EXPECT_LT(std::abs(once["water_force_error"].get<double>()), 1e-9);
    EXPECT_LT(std::abs(once["water_error"].get<double>()), 1e-11);
    EXPECT_GT(once["overpressure_ratio_mean"].get<double>(), 0.01);
    EXPECT_GT(once["fluid_closure"].get<double>(), 0.0);
    // 0.029 where one ratio of mud to cells served everywhere; 22 discs of sediment.
    EXPECT_LT(once["fluid_closure"].get<double>(), 0.01);
    // Lift of sediment is pressure on rock and base; here hardly any sediment is on the base.
    const State end = end_of("once");
    double sum = 0.0, size = 0.0;
    for (const double force : end.base_nodes.get<double>("excess_y"))
        sum += force;
    for (const double force : end.discs.get<double>("lift")) {
        sum += force;
        size += std::abs(force);
    }
    EXPECT_GT(size, 0.0);
    EXPECT_NEAR(sum, 0.0, 1e-12 * size);
    EXPECT_EQ(run("threads", {}, {}, false, 2)["state_hash"], once["state_hash"]);
    run("parts", {}, 62.5); // between two windows
    EXPECT_EQ(run("parts", {}, {}, true)["state_hash"], once["state_hash"]);
}

/// Porous rock down to the base, whose pressure the base bears on all of its length.
TEST_F(WaterOnABase, BearsThePressureOfRockThatDrains) {
    const std::vector<std::string> rock{
        R"(layer=[{name="sandstone", top_m=0.0, thickness_m=1500.0, material="mat18-b", )"
        R"(permeability_m2=1e-17}])"};
    const json once = run("once", rock);
    EXPECT_LT(std::abs(once["water_force_error"].get<double>()), 1e-9);
    EXPECT_LT(std::abs(once["water_error"].get<double>()), 1e-11);
    EXPECT_GT(once["rock_overpressure_ratio"].get<double>(), 0.0);
    // 1.2 where one ratio of mud to cells served rock, too.
    EXPECT_LT(run("parts", rock, 75.0)["fluid_closure"].get<double>(), 0.02);
    const State end = end_of("once");
    double sum = 0.0, size = 0.0;
    int pressed = 0;
    for (const double force : end.base_nodes.get<double>("excess_y")) {
        sum += force;
        pressed += force != 0.0;
    }
    EXPECT_GT(pressed, 10);
    for (const double force : end.discs.get<double>("lift")) {
        sum += force;
        size += std::abs(force);
    }
    EXPECT_NEAR(sum, 0.0, 1e-12 * size);
    EXPECT_EQ(run("threads", rock, {}, false, 2)["state_hash"], once["state_hash"]);
    run("parts", rock, 62.5); // between two windows
    EXPECT_EQ(run("parts", rock, {}, true)["state_hash"], once["state_hash"]);
}

/// Water at rest on a base that hardly moves weighs nothing beyond the start's; it falls by 1 km
/// and comes back.
TEST_F(WaterOnABase, DryGroundWeighsInFull) {
    const std::vector<std::string> rest{"pore_fluid.hydrostatic=true"};
    const json wet = run("wet", rest);
    std::vector<std::string> falls = rest;
    falls.push_back("stage=[{distance_m=50.0, water_level_m=-1000.0}, {distance_m=50.0, "
                    "water_level_m=0.0}]");
    run("low", falls, 50.0);
    const auto pushed = [&](const std::string& name) {
        const State end = end_of(name);
        double sum = 0.0;
        for (const double push : end.discs.get<double>("push_y"))
            sum -= push;
        return sum;
    };
    // 1 km of some 3 to 4 km of ground, without pores.
    const double at_rest = pushed("wet"), low = pushed("low");
    EXPECT_GT(low, at_rest + 1000.0 * 3000.0 * 0.7 * 1030.0 * 9.81);
    EXPECT_LT(low, at_rest + 1000.0 * 5000.0 * 1030.0 * 9.81);
    const json back = run("low", falls, {}, true);
    EXPECT_LT(std::abs(back["water_force_error"].get<double>()), 1e-9);
    EXPECT_NEAR(pushed("low"), at_rest, 0.05 * low); // the ground's roughness by packing
    EXPECT_NEAR(back["water_load_n_per_m"].get<double>(), wet["water_load_n_per_m"].get<double>(),
                0.02 * 1030.0 * 9.81 * 1000.0 * 4000.0);
    EXPECT_EQ(run("straight", falls)["state_hash"], back["state_hash"]);
}

TEST_F(WaterOnABase, GoesOnAfterAKillWhileTheLevelFalls) {
    const std::vector<std::string> falls{
        "output.interval_m=6.25",
        "stage=[{distance_m=50.0, water_level_m=-1000.0}, {distance_m=50.0, water_level_m=0.0}]"};
    const json once = run("once", falls);
    const fs::path file = folder / "falls.toml";
    std::ofstream(file) << scene;
    std::vector<std::string> words{"run",
                                   file.string(),
                                   "--quiet",
                                   "--threads",
                                   "1",
                                   "--output",
                                   (folder / "killed").string()};
    for (const std::string& set : falls)
        words.insert(words.end(), {"--set", set});
    const auto is_there = [&] {
        return fs::exists(folder / "killed/snapshots") &&
               std::ranges::any_of(list_snapshots(folder / "killed"), [](const fs::path& path) {
                   return snapshot_extension(path) > 20.0;
               });
    };
    const Program program(folder, words);
    while (program.runs() && !is_there())
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    program.send(SIGKILL);
    ASSERT_EQ(program.wait().code, -SIGKILL) << "ended before it was killed";
    words.emplace_back("--resume");
    EXPECT_EQ(Program(folder, words).wait().code, 0);
    EXPECT_EQ(json::parse(contents(folder / "killed/summary.json"))["state_hash"],
              once["state_hash"]);
}

TEST_F(WaterOnABase, IsExplained) {
    // 1030 kg/m^3 times 9.81 m/s^2 times the area above the detachment.
    EXPECT_THAT(explain(SceneRuns::load(scene), 1, program_effects()),
                AllOf(HasSubstr("water presses on the base with "),
                      HasSubstr("dry is what lies above it")));
    EXPECT_THAT(
        explain(SceneRuns::load(scene, {"pore_fluid.hydrostatic=true", "stage=[{distance_m=100.0, "
                                                                       "water_level_m=-300.0}]"}),
                1, program_effects()),
        AllOf(HasSubstr("Level 0 m, -300 m in the end"),
              HasSubstr("the uppermost 300 m of rock get dry")));
}

TEST_F(WaterOnABase, RefusesTwoWaters) {
    EXPECT_EQ(refusal({}, "[basin_water]\n"), "accepted");
    EXPECT_THAT(refusal({"pore_fluid.level_m=-100"}, "[basin_water]\n"),
                AllOf(HasSubstr("basin_water.level_m"), HasSubstr("stands at -100"),
                      HasSubstr("give both the same")));
    EXPECT_THAT(refusal({"pore_fluid.fluid_density_kg_per_m3=1100"}, "[basin_water]\n"),
                AllOf(HasSubstr("basin_water.density_kg_per_m3"), HasSubstr("1100")));
    const std::string stages = "stage=[{distance_m=100.0, water_level_m=-100.0}]";
    EXPECT_THAT(refusal({stages}, "[basin_water]\n"),
                AllOf(HasSubstr("basin_water"), HasSubstr("water_level_m")));
    const std::string fluid = "[pore_fluid]\npermeability_m2 = 1e-21\n";
    std::string dry = scene;
    dry.erase(dry.find(fluid), fluid.size());
    EXPECT_THAT(message_of<SceneError>([&] { SceneRuns::load(dry, {stages}); }),
                AllOf(HasSubstr("stage[0].water_level_m"), HasSubstr("no water acts")));
    EXPECT_THAT(refusal({"pore_fluid.fluid_density_kg_per_m3=2590",
                         "elastic_base.crust_density_kg_per_m3=2400",
                         "elastic_base.mantle_density_kg_per_m3=2500"}),
                HasSubstr("fluid_density_kg_per_m3"));
}

} // namespace
} // namespace listric::fem_water_base_test
