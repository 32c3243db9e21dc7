// Water in the pores from the scene to the discs: what it leaves as it is, what it keeps, and what
// it refuses.

#include "apps/commands/explain.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/sections/export_run.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "tests/message_of.hpp"
#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace listric::pore_fluid_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using namespace support;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class PoreFluidRun : public SceneRuns {
protected:
    /// Every effect but an elastic base, with strata that are thin.
    static Scene with(std::vector<std::string> set) {
        for (const char* also :
             {"sedimentation.target=[[0.0,0.0]]", "sedimentation.interval_a=2500"})
            set.insert(set.begin(), also);
        return load_scene({.scene = test_scene("every-effect.toml"), .set = set});
    }

    static std::string refusal(const std::vector<std::string>& set,
                               const std::vector<std::string>& without = {}) {
        return support::message_of<SceneError>([&] {
            load_scene({.scene = test_scene("every-effect.toml"), .set = set, .without = without});
        });
    }

    nlohmann::json run_with(const std::string& name, const std::vector<std::string>& set,
                            int threads = 1, bool plain = false) const {
        RunOptions o = options(name);
        o.threads = threads;
        o.plain = plain;
        o.force = true;
        return run(with(set), o);
    }

    State last_state(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back()).state;
    }
};

TEST_F(PoreFluidRun, WaterAtRestIsLessGravity) {
    const auto water = run_with("water", {"pore_fluid.hydrostatic=true"});
    const auto less = run_with(
        "less", {fmt::format("gravity.acceleration_m_per_s2={}", 9.81 * (1.0 - 1030.0 / 2600.0))});
    EXPECT_EQ(water["state_hash"], less["state_hash"]);
    EXPECT_FALSE(last_state("water").discs.has("excess_pressure"));
    EXPECT_FALSE(water.contains("overpressure_ratio_mean"));
}

TEST_F(PoreFluidRun, HasTheSameBitsHoweverItIsRun) {
    const std::vector<std::string> mud{"pore_fluid.permeability_m2=1e-19"};
    const auto once = run_with("once", mud);
    EXPECT_EQ(run_with("plain", mud, 1, true)["state_hash"], once["state_hash"]);
    for (const int threads : {2, 4})
        EXPECT_EQ(run_with("threads", mud, threads)["state_hash"], once["state_hash"]) << threads;
    RunOptions o = options("parts");
    o.until = 112.5; // between two solutions
    run_scene(with(mud), o);
    o.until = {};
    o.resume = true;
    EXPECT_EQ(run(with(mud), o)["state_hash"], once["state_hash"]);
    EXPECT_LE(std::abs(once["water_error"].get<double>()), 1e-12);
    EXPECT_LE(once["newton_worst"].get<double>(), 8.0);
    EXPECT_GT(once["overpressure_ratio_mean"].get<double>(), 0.01);
    EXPECT_GT(once["water_eroded_m2"].get<double>(), -1e-6);
    EXPECT_THAT(contents(folder / "once/history.csv"), HasSubstr("overpressure_ratio_mean"));
}

/// Between two strata (every 50 m) in a pause, and where a stage lays nothing down or erodes: what
/// is pending follows from the state alone.
TEST_F(PoreFluidRun, GoesOnBetweenTwoStrata) {
    const std::vector<std::string> set{
        "sedimentation.interval_a=5000", "pore_fluid.permeability_m2=1e-20",
        "pore_fluid.permeability_ratio=5",
        "stage=[{distance_m=75.0}, {pause_a=2500}, {distance_m=50.0, sedimentation=\"none\"}, "
        "{distance_m=50.0, sedimentation=\"erode\"}]"};
    const auto once = run_with("once", set);
    EXPECT_LE(std::abs(once["water_error"].get<double>()), 1e-12);
    EXPECT_GT(once["overpressure_ratio_mean"].get<double>(), 0.01);
    for (const double until : {87.5, 137.5}) {
        RunOptions o = options("parts");
        o.force = true;
        o.until = until;
        run_scene(with(set), o);
        o.until = {};
        o.force = false;
        o.resume = true;
        EXPECT_EQ(run(with(set), o)["state_hash"], once["state_hash"]) << until;
    }
}

TEST_F(PoreFluidRun, BedsGoOnFromAnyMoment) {
    const std::vector<std::string> set{
        "pore_fluid.permeability_m2=1e-19",
        R"(bed=[{material="mud", until_a=6e3}, {material="sand", permeability_ratio=5.0, until_a=12e3},)"
        R"( {surface_porosity=0.6, specific_surface_per_m=1e8, fault_across=0.1}])"};
    const auto once = run_with("once", set);
    EXPECT_LE(std::abs(once["water_error"].get<double>()), 1e-12);
    EXPECT_EQ(run_with("threads", set, 3)["state_hash"], once["state_hash"]);
    RunOptions o = options("parts");
    for (const double until : {55.0, 112.5}) { // within the first bed, and the second
        o.force = true;
        o.resume = false;
        o.until = until;
        run_scene(with(set), o);
        o.until = {};
        o.force = false;
        o.resume = true;
        EXPECT_EQ(run(with(set), o)["state_hash"], once["state_hash"]) << until;
    }
    // Fresh discs have the pores of their bed.
    const State state = last_state("once");
    const ConstDiscColumns d = disc_columns(state);
    const auto porosity = state.discs.get<double>("porosity");
    std::map<int, double> highest;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] > 0)
            highest[d.stratum[i]] = std::max(highest[d.stratum[i]], porosity[i]);
    std::set<double> told;
    for (const auto& [stratum, most] : highest) {
        const double fresh = stratum <= 2 ? 0.63 : stratum <= 4 ? 0.49 : 0.6;
        EXPECT_LE(most, fresh) << stratum;
        EXPECT_GT(most, fresh - 0.08) << stratum;
        told.insert(fresh);
    }
    EXPECT_GE(told.size(), 2u);
}

TEST_F(PoreFluidRun, BedsOfOneKindChangeNothing) {
    // Beds that say what all sediment is are no change.
    const std::vector<std::string> mud{"pore_fluid.permeability_m2=1e-19"};
    std::vector<std::string> beds = mud;
    beds.emplace_back("bed=[{until_a=6e3}, {}]");
    EXPECT_EQ(run_with("beds", beds)["state_hash"], run_with("none", mud)["state_hash"]);
}

TEST_F(PoreFluidRun, DrainsAlongTheBeds) {
    const auto ratio = [&](const char* along) {
        return run_with("beds", {fmt::format("pore_fluid.permeability_ratio={}", along),
                                 "pore_fluid.permeability_m2=1e-20"})["overpressure_ratio_mean"]
            .get<double>();
    };
    EXPECT_LT(ratio("100"), ratio("1"));
}

/// A layer of rock below the basin takes up pressure of its mud; without the key it is as tight as
/// ever.
TEST_F(PoreFluidRun, RockOfALayerDrains) {
    const auto with_layer = [](const std::string& water) {
        return std::vector<std::string>{
            "pore_fluid.permeability_m2=1e-20",
            fmt::format(R"(layer=[{{name="sandstone", top_m=0.0, thickness_m=800.0, )"
                        R"(material="mat18-b"{}}}])",
                        water)};
    };
    const auto drains = with_layer(", permeability_m2=1e-15, permeability_ratio=3.0");
    const auto tight = run_with("tight", with_layer(""));
    const auto once = run_with("once", drains);
    EXPECT_LE(std::abs(once["water_error"].get<double>()), 1e-11);
    EXPECT_GT(once["water_rock_m2"].get<double>(), 0.1 * 4000.0 * 500.0);
    EXPECT_FALSE(tight.contains("water_rock_m2"));
    EXPECT_GT(once["rock_overpressure_ratio"].get<double>(), 0.0);
    EXPECT_LT(once["overpressure_ratio_mean"].get<double>(),
              0.9 * tight["overpressure_ratio_mean"].get<double>());
    EXPECT_FALSE(last_state("tight").discs.has("start_grains"));
    EXPECT_EQ(run_with("threads", drains, 2)["state_hash"], once["state_hash"]);
    RunOptions o = options("parts");
    o.until = 112.5; // between two solutions
    run_scene(with(drains), o);
    o.until = {};
    o.resume = true;
    EXPECT_EQ(run(with(drains), o)["state_hash"], once["state_hash"]);
    // Wells and figures go on into the rock.
    EXPECT_GT(once["pressure_profile"].size(), tight["pressure_profile"].size());
    EXPECT_THAT(explain(with(drains), 1, program_effects()),
                AllOf(HasSubstr("rock sandstone drains: 1e-15 m2, 3 times as much along bedding"),
                      HasSubstr("across its 800 m in ")));
}

TEST_F(PoreFluidRun, GenesisOfALayerKnowsNothingOfItsWater) {
    const auto start = [](const std::string& water) {
        return to_toml(genesis_of(with(
            {"pore_fluid={}", fmt::format(R"(layer=[{{name="a", top_m=0.0, thickness_m=800.0, )"
                                          R"(material="mat18-b"{}}}])",
                                          water)})));
    };
    EXPECT_EQ(start(""), start(", permeability_m2=1e-15, porosity=0.2"));
}

TEST_F(PoreFluidRun, RefusesRockThatCannotDrain) {
    const auto layer = [](const std::string& keys) {
        return fmt::format(
            R"(layer=[{{name="a", top_m=0.0, thickness_m=800.0, material="mat18-b", {}}}])", keys);
    };
    EXPECT_THAT(refusal({layer("permeability_m2=1e-15")}),
                AllOf(HasSubstr("layer[0].permeability_m2"), HasSubstr("is 1e-15"),
                      HasSubstr("add [pore_fluid]")));
    for (const char* key : {"porosity=0.2", "permeability_ratio=2", "compressibility_per_pa=1e-10"})
        EXPECT_THAT(refusal({"pore_fluid={}", layer(key)}),
                    AllOf(HasSubstr("layer[0]."), HasSubstr("flows through a, and none does"),
                          HasSubstr("permeability_m2")))
            << key;
    EXPECT_THAT(refusal({"pore_fluid={}", layer("permeability_m2=1e-9")}),
                AllOf(HasSubstr("layer[0].permeability_m2"), HasSubstr("1e-09"),
                      HasSubstr("at most 1e-12")));
    EXPECT_THAT(refusal({"pore_fluid={}", layer("permeability_m2=1e-15, porosity=0.0")}),
                AllOf(HasSubstr("layer[0].porosity"), HasSubstr("at least 0.01")));
}

/// Killed where water has been solved for (every 50 m) and compaction (every 25 m) has not followed
/// it yet; what is left is the snapshot, in which pressure pushes discs.
TEST_F(PoreFluidRun, GoesOnAfterAKillBetweenFluidAndCompaction) {
    const std::vector<std::string> mud{"pore_fluid.permeability_m2=1e-22",
                                       "pore_fluid.interval_a=5000", "output.interval_m=12.5"};
    const auto once = run_with("once", mud);
    std::vector<std::string> words{"run",
                                   test_scene("every-effect.toml"),
                                   "--quiet",
                                   "--threads",
                                   "1",
                                   "--output",
                                   (folder / "killed").string(),
                                   "--set",
                                   "sedimentation.target=[[0.0,0.0]]",
                                   "--set",
                                   "sedimentation.interval_a=2500"};
    for (const std::string& set : mud)
        words.insert(words.end(), {"--set", set});
    const auto is_there = [&] {
        return fs::exists(folder / "killed/snapshots") &&
               std::ranges::any_of(list_snapshots(folder / "killed"), [](const fs::path& path) {
                   return snapshot_extension(path) > 110.0;
               });
    };
    const Program program(folder, words);
    while (program.runs() && !is_there())
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    program.send(SIGKILL);
    ASSERT_EQ(program.wait().code, -SIGKILL) << "ended before it was killed";
    const State left = last_state("killed");
    EXPECT_LT(left.clock.travel.m, 190.0);
    EXPECT_GT(std::ranges::max(left.discs.get<double>("excess_pressure")), 1e5);
    EXPECT_GT(std::ranges::max(left.discs.get<double>("push_y")), 0.0);

    words.push_back("--resume");
    EXPECT_EQ(Program(folder, words).wait().code, 0);
    const auto summary = nlohmann::json::parse(contents(folder / "killed/summary.json"));
    EXPECT_EQ(summary["state_hash"], once["state_hash"]);
    // In the process itself: at both events, between them, and at compaction alone.
    for (const double until : {100.0, 112.5, 125.0}) {
        RunOptions o = options(fmt::format("until-{}", until));
        o.until = until;
        run_scene(with(mud), o);
        o.until = {};
        o.resume = true;
        EXPECT_EQ(run(with(mud), o)["state_hash"], once["state_hash"]) << until;
    }
}

TEST_F(PoreFluidRun, WaterIsConservedOverErosion) {
    const auto summary =
        run_with("eroded", {"pore_fluid.permeability_m2=1e-19",
                            "sedimentation.target=[{time_a = 0.0, points = [[0.0, 0.0]]}, "
                            "{time_a = 12000.0, points = [[0.0, 0.0]]}, "
                            "{time_a = 20000.0, points = [[0.0, -250.0]]}]"});
    EXPECT_LE(std::abs(summary["water_error"].get<double>()), 1e-12);
    EXPECT_GT(summary["water_eroded_m2"].get<double>(), 0.0);
}

TEST_F(PoreFluidRun, EnergyClosesWithTheWorkOfPressure) {
    const auto summary = run_with("energy", {"pore_fluid.permeability_m2=1e-19", "energy={}"});
    EXPECT_NE(summary["pore_fluid_work_j_per_m"].get<double>(), 0.0);
    // As without the fluid: 1.1e-5 (recorded with every-effect).
    EXPECT_LT(std::abs(summary["energy_residual"].get<double>()), 2e-5);
}

TEST_F(PoreFluidRun, WithoutPushesItOnlyKeepsPores) {
    const auto summary =
        run_with("control", {"pore_fluid.permeability_m2=1e-19", "pore_fluid.pushes=false"});
    EXPECT_GT(summary["overpressure_ratio_mean"].get<double>(), 0.01);
    EXPECT_FALSE(last_state("control").discs.has("push_x"));
}

TEST_F(PoreFluidRun, Limits) {
    const auto sand = run_with("sand", {"pore_fluid.permeability_m2=1e-13"});
    EXPECT_LT(sand["overpressure_ratio_mean"].get<double>(), 1e-3);
    const auto tight = run_with("tight", {"pore_fluid.permeability_m2=1e-22"});
    const double came = tight["water_came_m2"].get<double>();
    EXPECT_LT(tight["water_surface_m2"].get<double>(), 1e-2 * came);
    EXPECT_LE(tight["overpressure_ratio_max"].get<double>(), 0.95); // 0.9 of the last solution's G
    EXPECT_GE(sand["deposited_fraction"].get<double>(), tight["deposited_fraction"].get<double>());
}

/// Numbers of a CSV file by column; words are left out.
std::map<std::string, std::vector<double>> columns_of(const fs::path& file) {
    std::istringstream lines(contents(file));
    std::string line, word;
    std::vector<std::string> names;
    std::getline(lines, line);
    for (std::istringstream words(line); std::getline(words, word, ',');)
        names.push_back(word);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        for (const std::string& name : names)
            if (std::getline(words, word, ',') && name != "name" && name != "depth_reference")
                columns[name].push_back(std::stod(word));
    }
    return columns;
}

TEST_F(PoreFluidRun, ExportsWells) {
    run_with("well", {"pore_fluid.permeability_m2=1e-19"});
    const fs::path run = folder / "well";
    const fs::path file = export_run({.kind = "well", .output = run}).back();
    EXPECT_THAT(contents(file), HasSubstr("depocentre"));
    auto of = columns_of(file);
    const std::size_t rows = of["ground_depth_m"].size();
    ASSERT_GE(rows, 1u);
    for (std::size_t k = 0; k < rows; ++k) {
        const double rest = of["rest_pressure_pa"][k], pressure = of["pressure_pa"][k];
        EXPECT_NEAR(rest, 1030.0 * 9.81 * of["ground_depth_m"][k], 1e-9 * rest);
        EXPECT_NEAR(pressure, rest + of["excess_pressure_pa"][k], 1e-9 * rest);
        EXPECT_NEAR(of["mud_weight_kg_per_m3"][k], 1030.0 * pressure / rest, 1e-6);
        EXPECT_NEAR(of["effective_stress_pa"][k], of["total_stress_pa"][k] - pressure, 1e-9 * rest);
        EXPECT_LT(of["fracture_pressure_pa"][k], of["total_stress_pa"][k]);
        EXPECT_GE(of["porosity"][k], of["normal_porosity"][k] - 0.02);
        EXPECT_GE(of["age_a"][k], 0.0);
    }
    const double x = of["x_m"][0];
    const auto one = columns_of(export_run({.kind = "well", .output = run, .wells = {x}}).back());
    EXPECT_EQ(one.at("pressure_pa")[0], of["pressure_pa"][0]);
    EXPECT_THROW(export_run({.kind = "well", .output = run, .wells = {1e6}}), UsageError);
    unsetenv("LISTRIC_PYTHON");
    fs::remove_all(run / "figures"); // a Python that an earlier test has found draws them
    draw_run({.output = run, .wells = {x}});
    EXPECT_THAT(std::distance(fs::directory_iterator(run / "figures"), {}), 1);
    EXPECT_THROW(draw_run({.output = run, .wells = {1e6}}), UsageError);
    EXPECT_THROW(export_run({.kind = "faults", .output = run, .wells = {x}}), UsageError);
}

TEST_F(PoreFluidRun, WellsHaveNoPressureWhereWaterIsAtRest) {
    run_with("rest", {"pore_fluid.hydrostatic=true"});
    std::vector<std::string> names;
    for (const fs::path& file : export_run({.kind = "well", .output = folder / "rest"}))
        names.push_back(file.filename().string());
    EXPECT_THAT(names, ElementsAre(StartsWith("burial-")));
}

TEST_F(PoreFluidRun, TakesPoresFromTheRockOfSediment) {
    const auto text = [](std::vector<std::string> set) {
        set.insert(set.begin(), "pore_fluid={}");
        return to_toml(load_scene({.scene = test_scene("every-effect.toml"), .set = set}));
    };
    EXPECT_THAT(text({"materials.sediment=sand"}),
                AllOf(HasSubstr("surface_porosity = 0.49"), HasSubstr("coefficient_per_km = 0.27"),
                      HasSubstr("permeability_m2 = 1e-14")));
    EXPECT_THAT(text({"materials.sediment=mud", "pore_fluid.permeability_m2=1e-20"}),
                AllOf(HasSubstr("surface_porosity = 0.63"), HasSubstr("permeability_m2 = 1e-20")));
    EXPECT_EQ(text({}), text({"materials.sediment=sediment"}));
    const fs::path file = folder / "clay.toml";
    write_text(file, "description = \"\"\n[material]\nnormal_stiffness_pa = 1e11\n"
                     "shear_stiffness_pa = 4e10\nfriction = 0.3\n[pores]\n"
                     "surface_porosity = 0.7\ncoefficient_per_km = 0.6\n");
    EXPECT_THAT(refusal({fmt::format("materials.sediment={}", file.string())}),
                AllOf(HasSubstr("pores"), HasSubstr("permeability_m2")));
}

TEST_F(PoreFluidRun, WarnsOfThickStrata) {
    const auto warnings = [](const std::vector<std::string>& set) {
        return load_scene({.scene = test_scene("every-effect.toml"), .set = set}).warnings;
    };
    EXPECT_THAT(warnings({"pore_fluid={}", "sedimentation.interval_a=50000"}),
                Contains(AllOf(HasSubstr("50000 a"), HasSubstr("every 10000 a or less"))));
    EXPECT_THAT(warnings({"pore_fluid={}", "sedimentation.interval_a=50000",
                          "extension.rate_m_per_a=0.002"}),
                Not(Contains(HasSubstr("thick"))));
    const auto thick = Contains(HasSubstr("thick"));
    EXPECT_THAT(warnings({"pore_fluid={}"}), Not(thick));
    EXPECT_THAT(warnings({"pore_fluid.hydrostatic=true", "sedimentation.interval_a=50000"}),
                Not(thick));
    EXPECT_THAT(warnings({"sedimentation.interval_a=50000"}), Not(thick));
}

TEST_F(PoreFluidRun, ExplainLetsTheFloorSinkInExtensionAlone) {
    const auto column = [](const std::vector<std::string>& more) {
        std::vector<std::string> set{"pore_fluid={}", "materials.sediment=mud"};
        set.insert(set.end(), more.begin(), more.end());
        const std::string text = explain(with(set), 1, program_effects());
        const std::size_t from = text.find("a floor that sinks");
        return text.substr(from, text.find("\n\n", from) - from);
    };
    EXPECT_THAT(column({}), StartsWith("a floor that sinks by 0.2 km"));
    EXPECT_EQ(column({}),
              column({"stage=[{distance_m=200.0}, {pause_a=1e6}]", "extension.distance_m=10200"}));
}

TEST_F(PoreFluidRun, ExplainTellsTheFractureLineAndGibsonsBounds) {
    const auto text = [](const std::string& permeability) {
        return explain(load_scene({.scene = "lis1-mud",
                                   .set = {"pore_fluid.permeability_m2=" + permeability}}),
                       1, program_effects());
    };
    // The limit of thin layers, not that of 100: .35 and .54.
    EXPECT_THAT(text("1e-18"), AllOf(HasSubstr("0.37 at 1 km, 0.55 at 4.5 km"),
                                     HasSubstr("0.949 of the weight of grains and water"),
                                     HasSubstr("water leaves while mud is buried")));
    EXPECT_THAT(text("2e-16"), HasSubstr("water is nearly at rest")); // Gibson's number 0.05
    EXPECT_THAT(text("5e-20"), HasSubstr("but through fractures"));   // 200
}

TEST_F(PoreFluidRun, GenesisDependsOnTheDensityOnly) {
    const auto text = [](const std::vector<std::string>& set) {
        return to_toml(genesis_of(with(set)));
    };
    EXPECT_EQ(text({"pore_fluid.permeability_m2=1e-19", "pore_fluid.interval_a=5000"}),
              text({"pore_fluid={}"}));
    EXPECT_NE(text({"pore_fluid.fluid_density_kg_per_m3=1100"}), text({"pore_fluid={}"}));
}

TEST_F(PoreFluidRun, RefusesWhatItCannotBe) {
    const std::vector<std::string> on{"pore_fluid={}"};
    for (const char* table : {"sedimentation", "gravity", "compaction"})
        EXPECT_THAT(refusal(on, {table}), AllOf(HasSubstr("pore_fluid"), HasSubstr(table)));
    EXPECT_THAT(
        refusal({"pore_fluid.interval_a=3000"}),
        AllOf(HasSubstr("pore_fluid.interval_a"), HasSubstr("multiple"), HasSubstr("2500")));
    EXPECT_THAT(refusal({"pore_fluid.permeability_m2=1e-9"}),
                AllOf(HasSubstr("pore_fluid.permeability_m2"), HasSubstr("1e-18 is mud"),
                      HasSubstr("darcy")));
    EXPECT_THAT(refusal({"pore_fluid={}", "hanging_wall.rock_density_kg_per_m3=2700"}),
                AllOf(HasSubstr("equal densities"), HasSubstr("2700"), HasSubstr("2600")));
    EXPECT_THAT(refusal({"pore_fluid.fluid_density_kg_per_m3=2700"}),
                AllOf(HasSubstr("fluid_density"), HasSubstr("floats")));
    EXPECT_THAT(refusal({"pore_fluid.fracture_ratio=1.1"}),
                AllOf(HasSubstr("fracture_ratio"), HasSubstr("at least 0.5, at most 1")));
    EXPECT_THAT(refusal({"pore_fluid={}", "compaction.coefficient_per_km=0"}),
                HasSubstr("compacts"));
}

} // namespace
} // namespace listric::pore_fluid_test
