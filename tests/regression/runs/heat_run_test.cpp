// Temperatures from the scene to the discs: what they leave as it is, what is kept, and what is
// refused.

#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/commands/explain.hpp"
#include "apps/figures/sections/export_run.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "tests/message_of.hpp"
#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace listric::heat_run_test {

using namespace dem;
namespace {

using namespace support;
using testing::AllOf;
using testing::HasSubstr;

class HeatRun : public SceneRuns {
protected:
    static Scene with(std::vector<std::string> set) {
        set.insert(set.begin(), "heat.interval_a=2500");
        return load_scene({.scene = test_scene("every-effect.toml"), .set = set});
    }

    static std::string refusal(const std::vector<std::string>& set) {
        return message_of<SceneError>([&] { with(set); });
    }

    nlohmann::json run_with(const std::string& name, const std::vector<std::string>& set,
                            int threads = 1) const {
        RunOptions o = options(name);
        o.threads = threads;
        o.force = true;
        return run(with(set), o);
    }

    State last_state(const std::string& name) const {
        return read_snapshot(list_snapshots(folder / name).back()).state;
    }
};

TEST_F(HeatRun, HasTheSameBitsHoweverItIsRun) {
    const auto once = run_with("once", {});
    EXPECT_EQ(run_with("threads", {}, 2)["state_hash"], once["state_hash"]);
    for (const double until : {60.0, 112.5}) {
        RunOptions o = options("parts");
        o.force = true;
        o.until = until;
        run_scene(with({}), o);
        o.until = {};
        o.force = false;
        o.resume = true;
        EXPECT_EQ(run(with({}), o)["state_hash"], once["state_hash"]) << until;
    }
    EXPECT_LE(std::abs(once["heat_balance_error"].get<double>()), 1e-10);
    EXPECT_GT(once["vitrinite_max_percent"].get<double>(), 0.2);
    EXPECT_GT(once["surface_heat_flow_mw_per_m2"].get<double>(), 1.0);
}

/// Temperatures move nothing.
TEST_F(HeatRun, LeavesTheDiscsWhereTheyAre) {
    run_with("warm", {});
    RunOptions o = options("cold");
    run(load_scene({.scene = test_scene("every-effect.toml")}), o);
    const State warm = last_state("warm"), cold = last_state("cold");
    EXPECT_THAT(disc_columns(warm).y, testing::ElementsAreArray(disc_columns(cold).y));
    EXPECT_TRUE(warm.discs.has("temperature"));
    EXPECT_FALSE(cold.discs.has("temperature"));
    EXPECT_FALSE(cold.discs.has("kerogen_1"));
}

/// A pause by steps is a solution by step: rock that nothing moves goes on to warm.
TEST_F(HeatRun, GoesOnInAPause) {
    constexpr int travel = 200; // of a step, m
    const auto paused = [&](const char* name, int steps) {
        return run_with(name,
                        {fmt::format("extension.distance_m={}", 100 + steps * travel),
                         fmt::format("stage=[{{distance_m=100.0}}, {{pause_a=4e6, step_a={}}}]",
                                     4000000 / steps)});
    };
    const auto fine = paused("fine", 8), coarse = paused("coarse", 4);
    EXPECT_LE(std::abs(fine["heat_balance_error"].get<double>()), 1e-10);
    EXPECT_GT(fine["vitrinite_max_percent"].get<double>(), 0.2);
    EXPECT_NEAR(fine["detachment_temperature_c"].get<double>(),
                coarse["detachment_temperature_c"].get<double>(), 0.5); // first order in time
}

/// Between steps, in a step, where it ends, and where the pause does.
TEST_F(HeatRun, HasTheSameBitsHoweverAPauseIsCut) {
    const std::vector<std::string> stages{
        "extension.distance_m=500",
        "stage=[{distance_m=100.0}, {pause_a=30e6, step_a=10e6, settle_m=100.0}, "
        "{distance_m=100.0}]"};
    const auto once = run_with("once", stages);
    for (const int threads : {2, 3})
        EXPECT_EQ(run_with("threads", stages, threads)["state_hash"], once["state_hash"])
            << threads;
    RunOptions o = options("parts");
    for (const double until : {100.0, 101.0, 150.0, 200.0, 299.0, 375.0, 400.0}) {
        o.until = until;
        o.threads = 1 + static_cast<int>(until) % 3;
        run_scene(with(stages), o);
        o.resume = true;
    }
    o.until = {};
    EXPECT_EQ(run(with(stages), o)["state_hash"], once["state_hash"]);
}

/// Sum of EASY%Ro's reactions after a path of temperatures, by the trapezoidal rule in steps of a
/// thousandth: a program of its own.
double reflectance_of(const std::vector<std::pair<double, double>>& path) {
    constexpr double shares[] = {3, 3, 4, 4, 5, 5, 6, 4, 4, 7, 6, 6, 6, 5, 5, 4, 3, 2, 2, 1};
    double reacted = 0.0;
    for (int reaction = 0; reaction < 20; ++reaction) {
        const double energy = (34.0 + 2.0 * reaction) * 4184.0;
        const auto rate = [&](double celsius) {
            return 1e13 * std::exp(-energy / (8.31446 * (celsius + 273.15)));
        };
        double integral = 0.0;
        for (std::size_t k = 1; k < path.size(); ++k) {
            constexpr int parts = 1000;
            const auto [start, from] = path[k - 1];
            const auto [end, to] = path[k];
            for (int part = 0; part < parts; ++part)
                integral += 0.5 *
                            (rate(std::lerp(from, to, part / 1000.0)) +
                             rate(std::lerp(from, to, (part + 1) / 1000.0))) *
                            (end - start) * 365.25 * 86400.0 / parts;
        }
        reacted += 0.01 * shares[reaction] * (1.0 - std::exp(-integral));
    }
    return std::exp(-1.6 + 3.7 * reacted);
}

/// A snapshot for each solution, so that a disc's path is known.
TEST_F(HeatRun, ReflectanceIsThatOfTheDiscsPath) {
    const std::vector<std::string> set{
        "output.interval_m=100",
        "heat.interval_a=10000",
        "heat.lithosphere_m=20e3",
        "heat.crust_m=10e3",
        "extension.distance_m=600",
        "stage=[{distance_m=200.0}, {pause_a=40e6, step_a=10e6, settle_m=100.0}]"};
    const Scene scene = with(set);
    run(scene, options("path"));
    const Calendar calendar = make_calendar(scene);
    std::map<std::int64_t, std::vector<std::pair<double, double>>> paths; // years, degrees Celsius
    State last;
    for (const auto& file : list_snapshots(folder / "path")) {
        last = read_snapshot(file).state;
        const auto temperature = last.discs.get<double>("temperature");
        for (std::size_t i = 0; i < temperature.size(); ++i)
            paths[disc_columns(std::as_const(last)).id[i]].emplace_back(
                calendar.age(last.clock.travel), temperature[i]);
    }
    const ConstDiscColumns d = disc_columns(std::as_const(last));
    double most = 0.0;
    for (std::size_t i = 0; i < d.id.size(); ++i) {
        const double found = last.discs.get<double>("vitrinite")[i];
        if (d.stratum[i] == 0 || found == 0.0)
            continue;
        most = std::max(most, found);
        EXPECT_NEAR(found, reflectance_of(paths.at(d.id[i])), 1e-3) << d.id[i];
    }
    EXPECT_GT(most, 0.25);
}

TEST_F(HeatRun, WellsAreExported) {
    run_with("once", {});
    export_run({.kind = "well", .output = folder / "once"});
    std::string text;
    for (const auto& file : std::filesystem::directory_iterator(folder / "once/export"))
        if (file.path().extension() == ".csv")
            text += contents(file.path());
    for (const char* column : {"temperature_c", "max_temperature_c", "vitrinite_percent"})
        EXPECT_THAT(text, HasSubstr(column));
}

TEST_F(HeatRun, RefusesWhatCannotBe) {
    EXPECT_THAT(refusal({"heat.lithosphere_m=20e3"}),
                AllOf(HasSubstr("heat.lithosphere_m"), HasSubstr("crust_m, 30000")));
    EXPECT_THAT(refusal({"heat.crust_m=1.2e3"}), HasSubstr("heat.crust_m: is 1200"));
    EXPECT_THAT(refusal({"heat.surface_temperature_c=100", "heat.base_temperature_c=100"}),
                HasSubstr("above surface_temperature_c, 100"));
    EXPECT_THAT(refusal({"heat.heat_production_w_per_m3=1e-5"}),
                AllOf(HasSubstr("heat.base_temperature_c: is 1333"),
                      HasSubstr("heat_production_w_per_m3 = 1e-05")));
    // A lithosphere's base that is colder than the crust's
    EXPECT_THAT(refusal({"heat.base_temperature_c=150"}),
                AllOf(HasSubstr("heat.base_temperature_c: is 150"), HasSubstr("raise it")));
    EXPECT_THAT(refusal({"heat.mantle_width_m=1e5"}), HasSubstr("no lower crust stretches"));
    EXPECT_THAT(refusal({"heat.conductivity_w_per_m_k=0"}),
                HasSubstr("heat.conductivity_w_per_m_k"));
}

} // namespace
} // namespace listric::heat_run_test
