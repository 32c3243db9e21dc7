// Motion in stages, [[stage]], on small scenes: the bits are those of one run however it is cut and
// by however many threads; one stage is what extension.distance_m is; bad stages are refused.

#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/observed_misfit.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "tests/message_of.hpp"
#include "tests/places.hpp"
#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>

namespace listric::stages_test {

using namespace dem;
namespace {

using namespace support;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Stages : public SceneRuns {
protected:
    static std::string text(const std::string& stages) {
        std::string scene = contents(test_scene("every-effect.toml"));
        const std::string distance = "distance_m = 200.0\n";
        EXPECT_NE(scene.find(distance), scene.npos);
        scene.erase(scene.find(distance), distance.size());
        const std::string detachment = "[detachment]\n";
        scene.insert(scene.find(detachment) + detachment.size(), "footwall_top_m = 2000.0\n");
        return scene + stages;
    }

    /// Out, a pause of 50 m of travel, and back at half the rate, pushed by the wall.
    static std::string there_and_back() {
        return text("[[stage]]\ndistance_m = 100.0\n"
                    "[[stage]]\npause_a = 5000.0\nsedimentation = \"fill\"\n"
                    "[[stage]]\ndistance_m = -50.0\nrate_m_per_a = 0.005\nbase = \"rests\"\n"
                    "detachment_friction = 0.1\nsedimentation = \"none\"\n"
                    "sediment_friction = 0.4\n");
    }

    std::string refusal(const std::string& scene, const std::vector<std::string>& set = {}) const {
        try {
            load(scene, set);
        } catch (const SceneError& error) {
            EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
            return error.what();
        }
        return "accepted";
    }
};

TEST_F(Stages, OneStageIsTheDistance) {
    const std::string plain = contents(test_scene("every-effect.toml"));
    std::string staged = plain;
    const std::string distance = "distance_m = 200.0\n";
    staged.erase(staged.find(distance), distance.size());
    staged += "[[stage]]\ndistance_m = 100.0\n";
    const auto summary = run(load(staged), "staged");
    const auto other = run(load(plain), "plain", 100.0);
    EXPECT_EQ(summary["extension_m"], other["extension_m"]);
    EXPECT_EQ(summary["travel_m"], other["extension_m"]);
    EXPECT_EQ(summary["state_hash"], other["state_hash"]);
    EXPECT_FALSE(other.contains("travel_m")); // a column of stages alone
    EXPECT_FALSE(nlohmann::json::parse(contents(options("plain").output / "status.json"))
                     .contains("travel_m"));
    EXPECT_FALSE(other.contains("stage"));
}

TEST_F(Stages, AreOneRunHoweverTheyAreCut) {
    const Scene scene = load(there_and_back());
    EXPECT_EQ(scene.extension.distance, 250.0);
    const auto whole = run(scene, "whole");
    EXPECT_NEAR(whole["extension_m"].get<double>(), 50.0, 0.1);
    EXPECT_NEAR(whole["travel_m"].get<double>(), 250.0, 0.1);
    EXPECT_EQ(whole["stage"], 2);
    const auto status = nlohmann::json::parse(contents(options("whole").output / "status.json"));
    EXPECT_EQ(status["extension_m"], whole["extension_m"]);
    EXPECT_EQ(status["travel_m"], whole["travel_m"]);
    EXPECT_EQ(status["stage"], 2);
    EXPECT_THAT(contents(options("whole").output / "log.txt"), HasSubstr("of net extension after"));
    EXPECT_LT(whole["mass_error_fraction"].get<double>(), 1e-12);

    RunOptions plain = options("plain");
    plain.plain = true;
    EXPECT_EQ(run(scene, plain)["state_hash"], whole["state_hash"]) << "plain cycle";
    EXPECT_EQ(run(scene, "two", {}, false, 2)["state_hash"], whole["state_hash"]) << "threads";
    // In every stage, and close before and behind the turns.
    run(scene, "cut", 60.0);
    for (const double until : {96.0, 103.0, 120.0, 147.0, 152.0, 200.0})
        run(scene, "cut", until, true);
    EXPECT_EQ(run(scene, "cut", {}, true)["state_hash"], whole["state_hash"]) << "resumed";
}

TEST_F(Stages, AFinishedRunIsKnownByItsTravel) {
    const auto resumed = [&](const Scene& scene, const std::string& name) {
        const std::filesystem::path summary = options(name).output / "summary.json";
        const auto before = std::filesystem::last_write_time(summary);
        run(scene, name, {}, true);
        return std::filesystem::last_write_time(summary) != before;
    };
    // The wall ends nearer to the breakaway than it has travelled.
    const Scene back = load(text("[[stage]]\ndistance_m = 60.0\n[[stage]]\ndistance_m = -40.0\n"));
    run(back, "back");
    EXPECT_FALSE(resumed(back, "back"));
    // Half way the extension is already more than the whole travel.
    const Scene fast = load(text("[[stage]]\ndistance_m = 20.0\n"
                                 "[[stage]]\ndistance_m = 80.0\nrate_m_per_a = 0.04\n"));
    ASSERT_EQ(fast.extension.distance, 40.0);
    EXPECT_GT(run(fast, "fast", 35.0)["extension_m"].get<double>(), 40.0);
    EXPECT_TRUE(resumed(fast, "fast"));
}

TEST_F(Stages, ThePauseIsARestAndLeavesSedimentationOn) {
    const std::string tables = "[[stage]]\ndistance_m = 60.0\n[[stage]]\npause_a = 14000.0\n";
    const auto after = run(load(text(tables)), "pause");
    const auto before = run(load(text(tables)), "before", 60.0);
    EXPECT_NEAR(after["extension_m"].get<double>(), before["extension_m"].get<double>(), 0.05);
    EXPECT_NEAR(after["elapsed_a"].get<double>() - before["elapsed_a"].get<double>(), 14e3, 20.0);
    // The target line sinks in the meantime.
    EXPECT_GT(after["eroded_fraction"].get<double>(), before["eroded_fraction"].get<double>());
}

TEST_F(Stages, EffectsThatTheEndComesBeforeAreSaid) {
    const auto warnings = [&](const char* interval) {
        return load(text("[[stage]]\ndistance_m = 50.0\n[[stage]]\npause_a = 5000.0\n"),
                    {fmt::format("sedimentation.interval_a={}", interval)})
            .warnings;
    };
    EXPECT_THAT(warnings("10000"), Not(testing::Contains(HasSubstr("sedimentation"))));
    EXPECT_THAT(warnings("20000"), // 200 m
                testing::Contains(HasSubstr("sedimentation.interval_a = 20000 is longer")));
}

TEST_F(Stages, EveryIntervalBeyondTheEndIsSaid) {
    const auto warnings =
        load(text("[[stage]]\ndistance_m = 50.0\n"),
             {"compaction.interval_a=1e6", "bond_healing.interval_a=1e6",
              "fault_weakening.interval_a=1e6", "fault_weakening.update_interval_a=1e6",
              "sedimentation.interval_a=1e6"})
            .warnings;
    for (const char* name :
         {"compaction.interval_a", "bond_healing.interval_a", "fault_weakening.interval_a",
          "fault_weakening.update_interval_a", "sedimentation.interval_a"})
        EXPECT_EQ(std::ranges::count_if(warnings,
                                        [&](const std::string& warning) {
                                            return warning.starts_with(std::string(name) + " = ");
                                        }),
                  1)
            << name;
}

TEST_F(Stages, ReadBackFromTheRunsRecord) {
    const Scene scene = load(there_and_back());
    const std::string record = to_toml(scene);
    EXPECT_THAT(record, HasSubstr("\n[[stage]]"));
    EXPECT_EQ(to_toml(load(record)), record);
    EXPECT_EQ(load(there_and_back(), {"stage.2.distance_m=-40"}).extension.distance, 230.0);
}

/// 500 m out, 100 m back at a quarter of the rate, while the level that is filled to rises: a pick
/// of a stratum laid down on the way back finds that stratum by its age. 2 s.
TEST_F(Stages, PicksAgesInTheShorteningFindTheirStrata) {
    std::string text = small_halfgraben();
    text.insert(text.find("[detachment]\n") + 13, "footwall_top_m = 2000.0\n");
    text += R"([extension]
speed_m_per_s = 1.0
[output]
figures_at_m = []
series = "none"
[gravity]
[sedimentation]
interval_a = 10000.0
target = [
    {time_a = 0.0, points = [[0.0, -400.0]]},
    {time_a = 50000.0, points = [[0.0, -400.0]]},
    {time_a = 90000.0, points = [[0.0, -20.0]]},
]
[[stage]]
distance_m = 500.0
[[stage]]
distance_m = -100.0
rate_m_per_a = 0.0025
sedimentation = "fill"
)";
    const Scene plain = load(text);
    run(plain, "picked");
    const archive::RunFolder folder_of_run(options("picked").output);
    const State state = folder_of_run.read(folder_of_run.snapshots.back()).state;
    EXPECT_NEAR(state.clock.travel.m, 900.0, 0.5);
    EXPECT_NEAR(state.clock.extension.m, 400.0, 0.5);
    const ModelParts& parts = folder_of_run.parts;
    const auto horizons =
        measures::trace_horizons(archive::make_setting(plain, parts), parts.base, state, {});
    // Picks of every stratum laid down after the turn, at 50,000 a; the run ends at 90,000.
    constexpr double turn = 50e3, end = 90e3;
    std::map<std::string, int> stratum_of;
    std::ofstream picks(folder / "picks.csv");
    picks << "name,x_m,depth_m,age_a\n";
    for (const measures::Horizon& h : horizons) {
        if (!h.deposited_at || *h.deposited_at <= turn || h.pieces.empty())
            continue;
        const std::string name = fmt::format("of {}", h.stratum);
        for (const measures::Polyline& piece : h.pieces)
            for (const Point& p : piece)
                picks << fmt::format("{},{:.3f},{:.3f},{:.3f}\n", name, p.x, -p.y,
                                     std::max(0.0, end - *h.deposited_at));
        stratum_of[name] = h.stratum;
    }
    picks.close();
    ASSERT_GE(stratum_of.size(), 2u);
    const Scene observed = load(text + "[observed]\nhorizons = \"picks.csv\"\n");
    const auto rows = archive::compare_horizons(observed, state, horizons);
    ASSERT_EQ(rows.size(), stratum_of.size());
    for (const archive::ObservedHorizon& row : rows) {
        ASSERT_TRUE(row.misfit) << row.objection;
        EXPECT_EQ(row.stratum, stratum_of.at(row.name));
        EXPECT_LT(row.misfit->mean, 1.0); // its own points; a neighbour lies tens of metres off
    }
}

TEST_F(Stages, AreRefusedWithTheirLine) {
    const std::string out = "[[stage]]\ndistance_m = 100.0\n";
    const auto of = [&](const std::string& stages) { return refusal(text(stages)); };
    EXPECT_THAT(of("[[stage]]\n"), AllOf(HasSubstr("stage[0].distance_m"), HasSubstr("pause_a")));
    EXPECT_THAT(of("[[stage]]\ndistance_m = 5.0\npause_a = 100.0\n"),
                AllOf(HasSubstr("stage[0].pause_a"), HasSubstr("give one")));
    EXPECT_THAT(of("[[stage]]\ndistance_m = 0.0\n"), HasSubstr("does nothing"));
    EXPECT_THAT(of("[[stage]]\ndistance_m = 9.0\nrate_m_per_a = 0.1\n"),
                AllOf(HasSubstr("stage[0].rate_m_per_a"), HasSubstr("extension.rate_m_per_a")));
    EXPECT_THAT(of(out + "[[stage]]\npause_a = 100.0\nrate_m_per_a = 0.1\n"),
                AllOf(HasSubstr("stage[1].rate_m_per_a"), HasSubstr("leave it out")));
    EXPECT_THAT(of(out + "[[stage]]\nbase = \"moved\"\n"), HasSubstr("sheet"));
    EXPECT_THAT(refusal(text(out), {"extension.distance_m=300"}),
                AllOf(HasSubstr("--set extension.distance_m=300"), HasSubstr("beside [[stage]]")));
    EXPECT_THAT(refusal(text(out), {"energy={}"}), HasSubstr("leave out one of the two"));

    const std::string lis = "inversion-lis1";
    const auto of_lis = [&](const std::vector<std::string>& set) {
        return support::message_of<SceneError>([&] { load_scene({.scene = lis, .set = set}); });
    };
    EXPECT_EQ(of_lis({}), "accepted");
    EXPECT_THAT(of_lis({"stage.1.distance_m=-27000"}),
                AllOf(HasSubstr("stage[1].distance_m"), HasSubstr("end of the last arc")));
    EXPECT_THAT(of_lis({"stage.1.distance_m=-8000", "detachment.footwall_top_m=2000"}),
                HasSubstr("lengthen"));
    std::string bare =
        contents(std::filesystem::path(source_folder) / "apps/scenes/inversion-lis1.toml");
    const std::size_t top = bare.find("footwall_top_m");
    bare.erase(top, bare.find('\n', top) - top);
    EXPECT_THAT(refusal(bare), AllOf(HasSubstr("stage[1].distance_m"), HasSubstr("-4000"),
                                     HasSubstr("add detachment.footwall_top_m")));
}

} // namespace
} // namespace listric::stages_test
