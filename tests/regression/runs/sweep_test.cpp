// `listric sweep` on scenes of a few hundred discs: killed and gone on, cut into tasks, with runs
// that fail.

#include "apps/archive/folder/output_folder.hpp"
#include "tests/program.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace listric::sweep_test {
namespace {

namespace fs = std::filesystem;
using support::contents;
using support::Ended;
using support::Program;
using testing::HasSubstr;
using testing::StartsWith;
using namespace std::chrono_literals;

const std::string scene = support::small_halfgraben() + R"([extension]
distance_m = 200.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 50.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
)";

const std::string plan = R"(scene = "small.toml"
seeds = 2
measures = ["unbalanced_ratio_mean", "inertial_number", "basement_unbonded_fraction@100"]
[[vary]]
parameter = "bonds.tensile_strength_pa"
values = [1e7, 1e8]
[[vary]]
parameter = "material.friction"
values = [0.3, 0.6]
)";

class SweepTest : public testing::Test {
protected:
    fs::path folder = fs::path(testing::TempDir()) /
                      fmt::format("listric-sweep-{}-{}", getpid(),
                                  testing::UnitTest::GetInstance()->current_test_info()->name());
    SweepTest() {
        fs::create_directories(folder);
        std::ofstream(folder / "small.toml") << scene;
        std::ofstream(folder / "plan.toml") << plan;
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    }
    ~SweepTest() override {
        unsetenv("XDG_CACHE_HOME");
        fs::remove_all(folder);
    }

    std::vector<std::string> words(const std::string& output,
                                   const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{
            "sweep", (folder / "plan.toml").string(), "--jobs", "2", "--output", path(output)};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    std::string path(const std::string& output) const { return (folder / output).string(); }
    Ended sweep(const std::string& output, const std::vector<std::string>& more = {}) const {
        return Program(folder, words(output, more)).wait();
    }
    /// Calls that --list prints.
    std::vector<std::string> listed(const std::string& output) const {
        std::vector<std::string> calls;
        std::istringstream lines(sweep(output, {"--list"}).out);
        for (std::string line; std::getline(lines, line);)
            calls.push_back(program_path + line.substr(std::string("listric").size()));
        return calls;
    }
    std::ptrdiff_t files(const std::string& run) const {
        std::ptrdiff_t number = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder / run))
            number += entry.is_regular_file() ? 1 : 0;
        return number;
    }
    std::string table(const std::string& output) const {
        return contents(folder / output / "sweep.csv");
    }
};

TEST_F(SweepTest, KilledInTheMiddleItGoesOnToTheSameTable) {
    const Ended whole = sweep("whole");
    ASSERT_EQ(whole.code, 0) << whole.err;
    EXPECT_THAT(table("whole"),
                StartsWith("run,seed,bonds.tensile_strength_pa,material.friction,outcome,exit_code,"
                           "state_hash,made_by,unbalanced_ratio_mean,inertial_number,basement_"
                           "unbonded_fraction@100\n"
                           "1,1,10000000,0.3,finished,0,"));
    const std::string rows = table("whole");
    EXPECT_EQ(std::ranges::count(rows, '\n'), 9);
    EXPECT_THAT(rows, testing::Not(HasSubstr(",,"))) << "a measure is missing";
    EXPECT_THAT(contents(folder / "whole/effects.csv"),
                HasSubstr("bonds.tensile_strength_pa:material.friction"));
    EXPECT_THAT(
        contents(folder / "whole/effects.csv"),
        StartsWith("measure,term,effect,standard_error,degrees_of_freedom,p,low_95,high_95\n"));
    // Four points and two seeds leave three degrees of freedom.
    EXPECT_THAT(contents(folder / "whole/effects.csv"),
                testing::ContainsRegex("\nunbalanced_ratio_mean,material.friction,[^,]+,[^,]+,3,"));
    EXPECT_THAT(whole.out, StartsWith("measure "));
    EXPECT_THAT(whole.out, testing::ContainsRegex("material.friction +[-.0-9e]+ +[.0-9e-]+ +3 +"));
    EXPECT_THAT(whole.err, HasSubstr("warning: two seeds show little of chance"));
    EXPECT_TRUE(fs::exists(folder / "whole/sheet.png")) << whole.err;
    EXPECT_TRUE(fs::exists(folder / "whole/effects.png")) << whole.err;

    const Program killed(folder, words("killed"));
    const auto start = std::chrono::steady_clock::now();
    while (killed.runs() && !fs::exists(folder / "killed/runs/0002-seed=2/summary.json") &&
           std::chrono::steady_clock::now() - start < 120s)
        std::this_thread::sleep_for(2ms);
    killed.send(SIGKILL);
    EXPECT_EQ(killed.wait().code, -SIGKILL);
    EXPECT_FALSE(fs::exists(folder / "killed/sweep.csv"));
    // Runs under way save and stop by themselves.
    const auto again = [&] { return sweep("killed"); };
    Ended resumed = again();
    for (int tries = 0; tries < 20 && contents(folder / "killed/sweep.csv") != rows; ++tries) {
        std::this_thread::sleep_for(200ms);
        resumed = again();
    }
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(table("killed"), rows);
    EXPECT_EQ(contents(folder / "killed/effects.csv"), contents(folder / "whole/effects.csv"));
}

TEST_F(SweepTest, RunsThatAnEngineMakesAreTheSweeps) {
    ASSERT_EQ(sweep("whole").code, 0);
    const std::vector<std::string> calls = listed("listed");
    ASSERT_EQ(calls.size(), 8u);
    EXPECT_THAT(calls.back(), HasSubstr("--set bonds.tensile_strength_pa=100000000"));
    EXPECT_THAT(calls.back(), testing::ContainsRegex("# [0-9]+ s, [0-9]+ MiB, [0-9]+ MB of disk"));
    for (std::size_t k = 0; k + 1 < calls.size(); ++k)
        ASSERT_EQ(std::system(calls[k].c_str()), 0) << calls[k];
    const std::vector<std::string> merge{"--merge", path("listed")};
    const Ended strict = sweep("listed", merge);
    EXPECT_EQ(strict.code, 2);
    EXPECT_THAT(strict.err, HasSubstr("run 4, seed 2 is in none of the folders, or not finished"));
    const Ended so_far = sweep("listed", {"--merge", path("listed"), "--so-far"});
    EXPECT_EQ(so_far.code, 0) << so_far.err;
    EXPECT_THAT(table("listed"), HasSubstr("\n4,2,100000000,0.6,not yet,130,,,,,\n"));
    for (const char* call : {"makes it", "leaves it alone"})
        ASSERT_EQ(std::system(calls.back().c_str()), 0) << call;
    ASSERT_EQ(sweep("listed", merge).code, 0);
    EXPECT_EQ(table("listed"), table("whole"));
    EXPECT_EQ(files("listed/runs/0001-seed=1"), 4 + 5); // a measure of a moment reads all
}

TEST_F(SweepTest, LeanRunsKeepFiveFiles) {
    std::ofstream(folder / "plan.toml")
        << plan.substr(0, plan.find(", \"basement")) + "]\n" + plan.substr(plan.find("[[vary"));
    const Ended lean = sweep("lean", {"--lean"});
    ASSERT_EQ(lean.code, 0) << lean.err;
    EXPECT_EQ(files("lean/runs/0001-seed=1"), 5);
    EXPECT_TRUE(fs::exists(folder / "lean/sheet.png")) << lean.err;
    // All seeds on one section, and a page that opens the runs.
    const Ended drawn = Program(folder, {"report", path("lean")}).wait();
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_THAT(contents(folder / "lean/report.html"), HasSubstr("href=\"runs/0001-seed%3D2/\""));
    EXPECT_THAT(contents(folder / "lean/seeds.csv"),
                HasSubstr("\n\"bonds.tensile_strength_pa = 1e7, material.friction = 0.3\","));
    EXPECT_TRUE(fs::exists(folder / "lean/seeds.png"));
    EXPECT_TRUE(fs::exists(folder / "lean/seeds-apart.png"));
    EXPECT_EQ(Program(folder, {"figures", path("lean")}).wait().code, 0) << "again";
    const auto json = nlohmann::json::parse(sweep("lean", {"--list", "--json"}).out);
    EXPECT_EQ(json.size(), 8u);
    EXPECT_EQ(json.at(3).at("folder"), path("lean/runs/0002-seed=2"));
    EXPECT_EQ(json.at(3).at("call").at(0), "listric");
}

TEST_F(SweepTest, FailedRunsOfAnEngineSayWhy) {
    std::ofstream(folder / "plan.toml")
        << "scene = \"small.toml\"\nmeasures = [\"inertial_number\"]\n[[vary]]\nparameter = "
           "\"cycle.time_step_safety\"\nvalues = [0.8, 8.0]\n";
    ASSERT_EQ(sweep("whole").code, 0);
    const std::vector<std::string> calls = listed("listed");
    EXPECT_EQ(std::system(calls[0].c_str()), 0);
    for (const char* reason : {"numerics", "failure.json"})
        EXPECT_NE(std::system((calls[1].substr(0, calls[1].find('#')) + " 2>/dev/null").c_str()), 0)
            << reason;
    EXPECT_EQ(sweep("listed", {"--merge", path("listed")}).code, 0);
    EXPECT_EQ(table("listed"), table("whole"));
}

TEST_F(SweepTest, TasksMergedAreOneTask) {
    ASSERT_EQ(sweep("whole").code, 0);
    std::vector<std::string> merge{"--merge"};
    for (int task = 1; task <= 4; ++task) {
        const std::string output = fmt::format("task-{}", task);
        const Ended ended = sweep(output, {"--task", fmt::format("{}/4", task)});
        ASSERT_EQ(ended.code, 0) << ended.err;
        EXPECT_FALSE(fs::exists(folder / output / "effects.csv"));
        merge.push_back(path(output));
    }
    const Ended merged = sweep("merged", merge);
    EXPECT_EQ(merged.code, 0) << merged.err;
    for (const char* file : {"sweep.csv", "effects.csv"})
        EXPECT_EQ(contents(folder / "merged" / file), contents(folder / "whole" / file)) << file;
    EXPECT_TRUE(fs::exists(folder / "merged/sheet.png"));

    // The tables tell enough, where the runs are elsewhere; those that are there are of this plan.
    fs::remove_all(folder / "task-1/runs");
    const Ended tables = sweep("tables", merge);
    EXPECT_EQ(tables.code, 0) << tables.err;
    EXPECT_THAT(tables.err, HasSubstr("warning: no sheet.png"));
    EXPECT_EQ(contents(folder / "tables/effects.csv"), contents(folder / "whole/effects.csv"));
    std::ofstream(folder / "plan.toml") << "set = \"extension.distance_m=250\"\n" + plan;
    const Ended other = sweep("other", merge);
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.err, HasSubstr("is of another plan: extension.distance_m = "));
    std::ofstream(folder / "plan.toml") << plan;

    merge.pop_back();
    const Ended incomplete = sweep("merged", merge);
    EXPECT_EQ(incomplete.code, 2);
    EXPECT_THAT(incomplete.err, HasSubstr("run 2, seed 2 is in none of the folders"));
    EXPECT_EQ(sweep("x", {"--task", "5/4"}).code, 2);
    EXPECT_EQ(sweep("none", {"--task", "99/99"}).code, 0); // more parts than runs
}

TEST_F(SweepTest, EqualHangingWallsAreMadeOnce) {
    const Ended ended = sweep("out");
    ASSERT_EQ(ended.code, 0) << ended.err;
    // Friction and bonds come after the packing: two seeds, two packings.
    int packings = 0;
    for (const auto& file : fs::directory_iterator(folder / "cache/listric"))
        packings += file.path().extension() == ".h5";
    int made = 0;
    for (const auto& run : fs::directory_iterator(folder / "out/runs"))
        made +=
            contents(run.path() / "log.txt").find("kept from an earlier run") == std::string::npos;
    EXPECT_EQ(made, packings);
}

TEST_F(SweepTest, AFailedRunIsARow) {
    const auto vary = [&](const std::string& values) {
        std::ofstream(folder / "plan.toml")
            << fmt::format("scene = \"small.toml\"\nmeasures = [\"inertial_number\"]\n[[vary]]\n"
                           "parameter = \"cycle.time_step_safety\"\nvalues = {}\n",
                           values);
    };
    vary("[0.8, 8.0]");
    const Ended some = sweep("some");
    EXPECT_EQ(some.code, 0) << some.err;
    EXPECT_THAT(some.err, HasSubstr("1 of them failed"));
    EXPECT_THAT(table("some"), HasSubstr("\n1,1,0.8,finished,0,"));
    EXPECT_THAT(table("some"), HasSubstr("\n2,1,8,"));
    EXPECT_THAT(contents(folder / "some/runs/0002-seed=1/status.json"),
                HasSubstr(R"("phase": "failed")"));
    EXPECT_THAT(table("some"), HasSubstr(",3,,,\n"));
    const std::string before = table("some");
    EXPECT_EQ(sweep("some").code, 0);
    EXPECT_EQ(table("some"), before);
    vary("[8.0, 9.0]");
    EXPECT_EQ(sweep("all").code, 3);
}

TEST_F(SweepTest, ItWritesWhereNobodyElseDoes) {
    std::ofstream(folder / "plan.toml")
        << "scene = \"small.toml\"\nmeasures = [\"inertial_number\"]\nset = "
           "\"extension.distance_m=100\"\n[[vary]]\nparameter = \"material.friction\"\n"
           "values = [0.3]\n";
    const fs::path run = folder / "out/runs/0001-seed=1";
    fs::create_directories(run);
    {
        const archive::FolderLock other(folder / "out");
        EXPECT_EQ(sweep("out").code, 2);
        EXPECT_FALSE(fs::exists(run / "failure.json"));
    }
    {
        const archive::FolderLock other(run);
        EXPECT_EQ(sweep("out").code, 3); // its only run
        EXPECT_THAT(table("out"), HasSubstr("another run is writing there,2,"));
        EXPECT_FALSE(fs::exists(run / "failure.json"));
    }
    std::ofstream(folder / "out/sweep.csv") << "my,own,table\n";
    const Ended foreign = sweep("out");
    EXPECT_EQ(foreign.code, 2);
    EXPECT_THAT(foreign.err, HasSubstr("sweep.csv: is no file of such a call"));
    EXPECT_EQ(table("out"), "my,own,table\n");
}

} // namespace
} // namespace listric::sweep_test
