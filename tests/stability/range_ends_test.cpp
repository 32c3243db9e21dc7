// Every number that a scene may hold, at both ends of its range: what is told of the run is finite,
// and the run ends or is refused, however odd its physics are.

#include "apps/commands/explain.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/forecast/oversize.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/words/spelling.hpp"
#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace listric::range_ends_test {
namespace {

using support::Ended;
using support::Program;
using testing::AnyOf;
using testing::Not;

class RangeEnds : public support::SceneRuns {};

/// "table.key=value" for both ends of all numbers in the tables of a scene; of several tables of a
/// name in the first.
std::vector<std::string> ends_in(const Scene& scene) {
    std::vector<std::string> ends;
    for (const SceneTable& table : scene_tables(program_effects())) {
        if (!table.in(scene))
            continue;
        for (const Parameter& parameter : table.parameters) {
            const bool whole = std::holds_alternative<Place<int>>(parameter.value);
            if (!whole && !std::holds_alternative<Place<double>>(parameter.value) &&
                !std::holds_alternative<Place<std::optional<double>>>(parameter.value))
                continue;
            const Range& range = parameter.range;
            const double least = std::isfinite(range.from) ? range.from : range.above,
                         greatest = std::isfinite(range.to)
                                        ? range.to
                                        : std::nextafter(range.below, -Range::infinity);
            for (const double value : {least, greatest}) {
                EXPECT_TRUE(range.contains(value))
                    << table.name << '.' << parameter.key << ": has no end within its range";
                const std::string number = text(value);
                ends.push_back(std::string(table.name) + (table.is_array() ? ".0." : ".") +
                               std::string(parameter.key) + '=' +
                               (whole ? std::to_string(static_cast<long>(value)) : number));
            }
        }
    }
    return ends;
}

SceneRequest request_of(const std::string& scene, const std::string& set,
                        std::vector<std::string> tables = {}) {
    tables.push_back(set);
    return {.scene = scene, .set = std::move(tables), .accuracy = "draft"};
}

/// How a call ends; a failure, and killed, if it takes more than a minute.
Ended ended_soon(const Program& program, const std::string& what) {
    const auto begun = std::chrono::steady_clock::now();
    while (program.runs() && std::chrono::steady_clock::now() - begun < std::chrono::seconds(60))
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const bool hangs = program.runs();
    if (hangs)
        program.send(SIGKILL);
    EXPECT_FALSE(hangs) << what;
    return program.wait();
}

const std::string every_effect = support::test_scene("every-effect.toml");

TEST_F(RangeEnds, ExplainIsFinite) {
    // Together they have every table with numbers.
    const std::vector<std::pair<std::string, std::vector<std::string>>> scenes{
        {every_effect, {}},
        {"lis1-mud", {}},
        {"lis1-elastic",
         {"lower_crust_thinning.thickness_m=20e3", "lower_crust_thinning.width_m=15e3",
          "basin_water={}", "footwall_erosion={}",
          R"(layer=[{name="salt", top_m=4000.0, thickness_m=1000.0, material="salt"}])",
          "old_fault=[{points=[[12000.0, 1000.0], [17000.0, 9000.0]]}]",
          "extension.distance_m=6000.0", "stage=[{distance_m=5000.0}, {pause_a=1e5}]"}}};
    for (const auto& [scene, tables] : scenes) {
        int told = 0;
        for (const std::string& end : ends_in(load_scene({.scene = scene, .set = tables}))) {
            std::string told_of_it;
            try {
                told_of_it = explain(load_scene(request_of(scene, end, tables)),
                                     {.team = 1e8, .one_thread = 1e8}, 2, program_effects());
            } catch (const SceneError&) {
                continue; // does not go with the rest of the scene
            }
            ++told;
            EXPECT_THAT(told_of_it, Not(testing::ContainsRegex("[^a-z](inf|nan)[^a-z]|-9223372")))
                << end;
        }
        EXPECT_GT(told, 10) << scene;
    }
}

TEST_F(RangeEnds, ARunEndsOrIsRefused) {
    const std::vector<std::string> ends = ends_in(load_scene({.scene = every_effect}));
    ASSERT_GT(ends.size(), 80u);
    int long_ones = 0;
    for (const std::string& end : ends) {
        try {
            const Scene scene = load_scene({.scene = every_effect, .set = {end}});
            if (predict(scene, {.team = 1e8, .one_thread = 1e8}).seconds >
                10.0) { // would end, or be refused, but not here
                ++long_ones;
                continue;
            }
        } catch (const SceneError&) {
        }
        const Program program(folder,
                              {"run", every_effect, "--until", "2m", "--set", end, "--threads", "1",
                               "--quiet", "--force", "--output", (folder / "out").string()});
        const Ended ended = ended_soon(program, end);
        EXPECT_THAT(ended.code, AnyOf(0, 2, 3)) << end << '\n' << ended.err;
        EXPECT_TRUE(ended.code == 0 || !ended.err.empty()) << end;
    }
    EXPECT_LT(long_ones, 10);
}

TEST_F(RangeEnds, WhatNobodyWaitsForIsRefusedByTheNameOfItsCause) {
    const auto cause = [](const char* set, double memory, double disk = 1e12) {
        const auto oversize =
            oversize_of(load_scene(request_of("lis1", set)), program_effects(), {memory, disk});
        return oversize ? oversize->parameter : "";
    };
    constexpr double memory = 24e9;
    EXPECT_EQ(cause("seed=1", memory), "");
    EXPECT_EQ(cause("cycle.time_step_safety=1e-6", memory), "cycle.time_step_safety");
    EXPECT_EQ(cause("extension.speed_m_per_s=1e-6", memory), "extension.speed_m_per_s");
    EXPECT_EQ(cause("output.interval_m=1e-6", memory), "output.interval_m");
    EXPECT_EQ(cause("hanging_wall.mean_radius_m=6", 1e9), "hanging_wall.mean_radius_m");
    EXPECT_EQ(cause("hanging_wall.mean_radius_m=6", memory), "");
    EXPECT_EQ(cause("sedimentation.level_m=100000", memory), "sedimentation.level_m");
    EXPECT_EQ(cause("sedimentation.target=[[0.0, 100000.0]]", memory), "sedimentation.target");
    EXPECT_EQ(cause("output.interval_m=0.5", memory, 20e9), "output.interval_m");
    EXPECT_EQ(cause("output.interval_m=0.5", memory), "");
}

// Found by the fuzzer: for each new vertex all former ones were looked at, two minutes long.
TEST_F(RangeEnds, ABaseOfManyElementsIsSoonChecked) {
    const std::filesystem::path deep = folder / "deep.toml";
    std::ofstream(deep) << R"([hanging_wall]
length_m = 20000.0
thickness_m = 1500.0
mean_radius_m = 90.0
[detachment]
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 30000.0}}]
[gravity]
[extension]
distance_m = 100.0
[elastic_base]
cell_size_m = 100.0
depth_m = 1e6
)";
    const Program program(folder, {"check", deep.string()});
    const Ended ended = ended_soon(program, "a deep base of small elements");
    EXPECT_THAT(ended.out + ended.err, // by the memory of the machine
                AnyOf(testing::HasSubstr("correct"), testing::HasSubstr("GB of memory")));
}

TEST_F(RangeEnds, ARefusalNamesFileValueAndCure) {
    const auto call = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"run",        "lis1",
                                       "--accuracy", "draft",
                                       "--set",      "cycle.time_step_safety=1e-6",
                                       "--output",   (folder / "out").string()};
        words.insert(words.end(), more.begin(), more.end());
        return Program(folder, words);
    };
    const Ended refused = call({}).wait();
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err,
                testing::AllOf(testing::HasSubstr("cycle.time_step_safety"),
                               testing::HasSubstr("1e-06"), testing::HasSubstr("--force-size")));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    // Its beginning is soon done.
    EXPECT_EQ(call({"--until", "0", "--force-size", "--quiet"}).wait().code, 0);
}

} // namespace
} // namespace listric::range_ends_test
