// Runs from beginning to end: reproducible, resumable after anything, honest about what fails.
// Most runs are made in-process; where signals and exit codes matter, by the program.

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/snapshot/checksum.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/run/run.hpp"
#include "dem/cycle/cycle.hpp"
#include "tests/places.hpp"
#include "tests/program.hpp"
#include "tests/small_halfgraben.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace listric::run_test {

using namespace archive;
using namespace dem;
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using support::contents;
using support::Ended;
using support::Program;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

// 565 discs, every effect, each at least twice in 300 m of extension.
const std::string small_scene = support::small_halfgraben("50.0") + R"([extension]
distance_m = 300.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 50.0
figures_at_m = []
[gravity]
[bonds]
[fault_weakening]
interval_a = 6000.0
strain_rate_per_s = 3e-14
youngest_sediment_a = 5000.0
[bond_healing]
[sedimentation]
interval_a = 6000.0
[compaction]
)";

/// Long enough to be caught in the middle.
const std::string slowly = "extension.speed_m_per_s=0.5";

void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

/// Every regular file below a folder, with its content and time of change.
std::map<std::string, std::pair<std::string, fs::file_time_type>> tree(const fs::path& folder) {
    std::map<std::string, std::pair<std::string, fs::file_time_type>> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[entry.path().string()] = {contents(entry.path()), entry.last_write_time()};
    return files;
}

/// Names of everything below a folder that ends as given.
std::vector<std::string> names_ending(const fs::path& folder, const std::string& ending) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().string().ends_with(ending))
            names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

json summary(const fs::path& output) { return json::parse(contents(output / "summary.json")); }

/// Part of the summary that depends on the scene alone.
json results(const fs::path& output) {
    json all = summary(output);
    for (const char* name : {"threads", "cycle_level", "wall_s", "predicted_wall_s",
                             "disc_steps_per_s", "time_by_part_s"})
        all.erase(name);
    return all;
}

void expect_same_run(const fs::path& run, const fs::path& other) {
    EXPECT_EQ(results(run), results(other));
    EXPECT_EQ(contents(run / "history.csv"), contents(other / "history.csv"));
    EXPECT_EQ(contents(run / "scene.toml"), contents(other / "scene.toml"));
    const Snapshot last = read_snapshot(list_snapshots(run).back());
    EXPECT_EQ(summary(other)["state_hash"].get<std::string>(),
              fmt::format("{:016x}", run_hash(last)));
}

/// A file under its final name is whole, whenever the program was stopped.
void expect_whole_files(const fs::path& output) {
    for (const auto& [path, file] : tree(output)) {
        const std::string& text = file.first;
        if (path.ends_with(".h5")) {
            EXPECT_NO_THROW(read_snapshot(path));
        } else if (path.ends_with(".json")) {
            EXPECT_TRUE(json::accept(text)) << path;
        } else if (path.ends_with(".toml")) {
            EXPECT_NO_THROW(load_scene({.scene = path}));
        } else if (path.ends_with(".csv")) {
            std::istringstream lines(text);
            std::set<std::ptrdiff_t> commas;
            for (std::string line; std::getline(lines, line);)
                commas.insert(std::ranges::count(line, ','));
            EXPECT_THAT(commas, SizeIs(1)) << path;
            EXPECT_TRUE(text.ends_with('\n')) << path;
        }
    }
}

bool all_finite(const Table& table) {
    return std::ranges::all_of(table.columns(), [](const Column& column) {
        const auto* values = std::get_if<std::vector<double>>(&column.values);
        return !values || std::ranges::all_of(*values, [](double x) { return std::isfinite(x); });
    });
}

bool same(const Table& a, const Table& b) {
    return a.rows() == b.rows() &&
           std::ranges::equal(a.columns(), b.columns(), [](const Column& p, const Column& q) {
               return p.name == q.name && p.values == q.values;
           });
}

/// Options of a run in-process.
struct How {
    std::optional<double> until = {};
    int threads = 1;
    bool resume = false, force = false, plain = false;
};

class RunTest : public testing::Test {
protected:
    RunTest() {
        fs::create_directories(folder);
        write(scene_file, small_scene);
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
        draw_with("exit 1");
    }
    ~RunTest() override {
        fs::remove_all(folder);
        unsetenv("XDG_CACHE_HOME");
        unsetenv("LISTRIC_PYTHON");
    }

    /// Pictures take longer than these runs: most tests have a Python that is none.
    void draw_with(const std::string& commands) const {
        const fs::path python = folder / "python";
        write(python, "#!/bin/sh\n" + commands + "\n");
        fs::permissions(python, fs::perms::owner_all);
        setenv("LISTRIC_PYTHON", python.c_str(), 1);
    }

    Scene scene(const std::vector<std::string>& set = {},
                const std::vector<std::string>& without = {}) const {
        return load_scene({.scene = scene_file.string(), .set = set, .without = without});
    }

    /// Runs a scene in-process; returns the output folder.
    fs::path run(const Scene& what, const std::string& name, const How& how = {}) const {
        RunOptions options;
        options.output = folder / name;
        options.until = how.until;
        options.threads = how.threads;
        options.resume = how.resume;
        options.force = how.force;
        options.plain = how.plain;
        options.quiet = true;
        EXPECT_EQ(run_scene(what, options), RunOutcome::finished);
        return options.output;
    }

    std::vector<std::string> run_words(const fs::path& output,
                                       const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words = {"run", scene_file.string(), "--output", output.string()};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    Ended call(const std::vector<std::string>& words,
               const std::function<void()>& prepare = {}) const {
        return Program(folder, words, prepare).wait();
    }

    Ended call_run(const fs::path& output, const std::vector<std::string>& more = {},
                   const std::function<void()>& prepare = {}) const {
        return call(run_words(output, more), prepare);
    }

    /// Starts a slow run and stops it with a signal once `there` holds.
    Ended stop_when(const fs::path& output, int signal, const std::function<bool()>& there) const {
        const Program program(folder, run_words(output, {"--set", slowly}));
        while (!there() && program.runs())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        program.send(signal);
        return program.wait();
    }

    /// Writes a snapshot anew with another state.
    void change_state(const fs::path& file, const std::function<void(State&)>& change) const {
        Snapshot snapshot = read_snapshot(file);
        change(snapshot.state);
        auto events = make_events(scene(), make_parts(scene()));
        for (auto& event : events) {
            event->memory = snapshot.event_memory.at(event->name());
            event->applied = snapshot.event_applied.at(event->name());
        }
        write_snapshot(file, snapshot.state, events, snapshot.record);
    }

    const fs::path folder = fs::path(testing::TempDir()) / fmt::format("listric-run-{}", getpid());
    const fs::path scene_file = folder / "small.toml";
};

// --------------------------------------------------------------------------------- reproducible

TEST_F(RunTest, TheSmallSceneCallsForEverything) {
    const fs::path output = run(scene(), "run");
    const State state = read_snapshot(list_snapshots(output).back()).state;
    const ConstDiscColumns d = disc_columns(state);
    EXPECT_GE(std::ranges::max(d.stratum), 2);
    EXPECT_GE(std::ranges::count(d.material, weak), 20);
    EXPECT_LT(std::ranges::min(state.discs.get<double>("porosity")), 0.5);
    for (const auto& [event, times] : read_snapshot(list_snapshots(output).back()).event_applied)
        EXPECT_GE(times, event == "strain" ? 0 : 2) << event; // strain has windows of 500 m
}

TEST_F(RunTest, CachedAndFreshGenesisGiveTheSameRun) {
    const fs::path fresh = run(scene(), "fresh");
    const fs::path cached = run(scene(), "cached");
    EXPECT_THAT(contents(cached / "log.txt"), HasSubstr("kept from an earlier run"));
    expect_same_run(cached, fresh);
    setenv("XDG_CACHE_HOME", (folder / "other cache").c_str(), 1);
    const fs::path fresh_again = run(scene(), "fresh again");
    EXPECT_THAT(contents(fresh_again / "log.txt"), Not(HasSubstr("kept from an earlier run")));
    expect_same_run(fresh_again, fresh);
}

TEST_F(RunTest, DamagedGenesisCacheIsMadeAnew) {
    const fs::path first = run(scene(), "first");
    const auto kept = names_ending(folder / "cache", ".h5");
    ASSERT_THAT(kept, SizeIs(1));
    fs::resize_file(folder / "cache/listric" / kept[0], 5000);
    const fs::path second = run(scene(), "second");
    EXPECT_THAT(contents(second / "log.txt"), HasSubstr("warning"));
    expect_same_run(second, first);
}

TEST_F(RunTest, UnwritableGenesisCacheIsAWarning) {
    write(folder / "in the way", "");
    setenv("XDG_CACHE_HOME", (folder / "in the way").c_str(), 1);
    const fs::path output = run(scene(), "run", {.until = 20.0});
    EXPECT_THAT(contents(output / "log.txt"), HasSubstr("hanging wall cannot be kept"));
    EXPECT_EQ(summary(output)["finished"], true);
}

TEST_F(RunTest, AnotherSeedGivesAnotherRun) {
    const fs::path one = run(scene(), "one", {.until = 60.0});
    const fs::path two = run(scene({"seed=2"}), "two", {.until = 60.0});
    EXPECT_NE(summary(one)["state_hash"], summary(two)["state_hash"]);
    EXPECT_NE(summary(one)["basin_area_m2"], summary(two)["basin_area_m2"]);
}

TEST_F(RunTest, NeitherThreadsNorTheKindOfCycleMatter) {
    const fs::path one = run(scene(), "one", {.threads = 1});
    const fs::path three = run(scene(), "three", {.threads = 3});
    EXPECT_EQ(summary(three)["threads"], 3);
    expect_same_run(three, one);
    expect_same_run(run(scene(), "plain", {.plain = true}), one);
}

// ------------------------------------------------------------------------------------ resumable

TEST_F(RunTest, UntilThenResumeEqualsUninterrupted) {
    const fs::path whole = run(scene(), "whole");
    // In the ramp, between events, at a window, just before and after one.
    for (const double until : {1.7, 133.7, 150.0, 199.96, 200.04}) {
        SCOPED_TRACE(until);
        const fs::path parts = run(scene(), fmt::format("until {}", until), {.until = until});
        EXPECT_NEAR(summary(parts)["extension_m"].get<double>(), until, 0.02);
        EXPECT_EQ(summary(parts)["finished"], true);
        run(scene(), parts.filename(), {.resume = true});
        expect_same_run(parts, whole);
    }
}

TEST_F(RunTest, YearsOfRestAreKept) {
    const std::vector<std::string> heals = {"fault_weakening.heal_after_a=12000",
                                            "fault_weakening.resting_rate_per_s=3e-13"};
    const fs::path whole = run(scene(heals), "whole");
    const auto weak_discs = [](const fs::path& output) {
        const State state = read_snapshot(list_snapshots(output).back()).state;
        return std::ranges::count(disc_columns(state).material, weak);
    };
    EXPECT_LT(weak_discs(whole), weak_discs(run(scene(), "for ever")));
    const fs::path parts = run(scene(heals), "parts", {.until = 133.7});
    run(scene(heals), parts.filename(), {.resume = true});
    expect_same_run(parts, whole);
}

TEST_F(RunTest, ManySmallPartsEqualUninterrupted) {
    const fs::path whole = run(scene(), "whole", {.until = 150.0});
    fs::path parts;
    for (int k = 1; k <= 15; ++k)
        parts = run(scene(), "parts", {.until = 10.0 * k, .resume = k > 1});
    expect_same_run(parts, whole);
}

TEST_F(RunTest, UntilZeroAndUntilBeyondTheEnd) {
    const fs::path none = run(scene(), "none", {.until = 0.0});
    EXPECT_EQ(summary(none)["extension_m"], 0.0);
    EXPECT_EQ(summary(none)["cycles"], 0);
    const fs::path whole = run(scene({"extension.distance_m=60"}), "whole");
    const fs::path beyond = run(scene({"extension.distance_m=60"}), "beyond", {.until = 20e3});
    expect_same_run(beyond, whole);
}

TEST_F(RunTest, InterruptedRunResumesToTheSameEnd) {
    const fs::path output = folder / "run";
    const Ended stopped =
        stop_when(output, SIGINT, [&] { return list_snapshots(output).size() >= 3; });
    EXPECT_EQ(stopped.code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, AllOf(HasSubstr("stopped at"), HasSubstr("--resume")));
    EXPECT_FALSE(fs::exists(output / "summary.json"));
    EXPECT_EQ(call_run(output, {"--set", slowly, "--resume"}).code, 0);
    expect_same_run(output, run(scene({slowly}), "whole"));
}

TEST_F(RunTest, InterruptedGenesisResumesToTheSameEnd) {
    const fs::path output = folder / "run";
    const Ended stopped =
        stop_when(output, SIGTERM, [&] { return fs::exists(output / "scene.toml"); });
    EXPECT_EQ(stopped.code, 130) << stopped.err;
    EXPECT_THAT(list_snapshots(output), IsEmpty());
    EXPECT_EQ(call_run(output, {"--set", slowly, "--resume"}).code, 0);
    expect_same_run(output, run(scene({slowly}), "whole"));
}

TEST_F(RunTest, TheAdviceToResumeWorksAsPrinted) {
    const fs::path output = folder / "an interrupted run";
    const Ended stopped =
        stop_when(output, SIGINT, [&] { return list_snapshots(output).size() >= 2; });
    const std::string before = "resume with: listric ";
    const std::size_t advice = stopped.err.find(before);
    ASSERT_NE(advice, std::string::npos) << stopped.err;
    const std::string words = stopped.err.substr(advice + before.size());
    const std::string line =
        fmt::format("'{}' {} 2>'{}'", program_path, words.substr(0, words.find('\n')),
                    (folder / "stderr").string());
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0) << line << contents(folder / "stderr");
    ASSERT_TRUE(fs::exists(output / "summary.json"));
    EXPECT_EQ(summary(output)["state_hash"], summary(run(scene({slowly}), "whole"))["state_hash"]);
}

class KilledRunTest : public RunTest, public testing::WithParamInterface<unsigned> {};

TEST_P(KilledRunTest, ResumesToTheSameEnd) {
    const fs::path output = folder / "run";
    std::mt19937 random(GetParam());
    // The first ones fall into genesis.
    for (int k = 0; k < 6; ++k) {
        const Program program(folder, run_words(output, {"--set", slowly, "--resume"}));
        const auto longest = std::min(600u, 200u * static_cast<unsigned>(k + 1));
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % longest));
        program.send(SIGKILL);
        program.wait();
        if (fs::exists(output))
            expect_whole_files(output);
    }
    const Ended last = call_run(output, {"--set", slowly, "--resume"});
    EXPECT_EQ(last.code, 0) << last.err;
    expect_whole_files(output);
    EXPECT_THAT(names_ending(output, ".part"), IsEmpty());
    expect_same_run(output, run(scene({slowly}), "whole"));
}

INSTANTIATE_TEST_SUITE_P(Seeds, KilledRunTest, testing::Values(1, 2, 3));

TEST_F(RunTest, WhatAKilledSessionHadHalfWrittenIsRemoved) {
    const fs::path output = folder / "run";
    for (const char* name :
         {".listric-write-test", "history.csv", "snapshots/extension-00000.00m.h5"})
        write(output / fmt::format("{}.123.part", name), "x");
    EXPECT_EQ(call_run(output, {"--until", "0"}).code, 0);
    EXPECT_THAT(names_ending(output, ".part"), IsEmpty());
}

TEST_F(RunTest, AKillWhileDrawingLeavesNothingBehind) {
    draw_with("sleep 0.2; exit 1");
    const fs::path output = folder / "run";
    stop_when(output, SIGKILL,
              [&] { return fs::exists(output / "figures") && !fs::is_empty(output / "figures"); });
    EXPECT_EQ(call_run(output, {"--set", slowly, "--resume"}).code, 0);
    EXPECT_TRUE(fs::is_empty(output / "figures"));
    EXPECT_THAT(names_ending(output, ".part"), IsEmpty());
}

TEST_F(RunTest, ResumeOfAFinishedRunChangesNothing) {
    const fs::path output = run(scene(), "run");
    const auto before = tree(output);
    const Ended again = call_run(output, {"--resume"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(call_run(output, {"--resume", "--until", "200m"}).code, 0);
    EXPECT_TRUE(tree(output) == before);
}

TEST_F(RunTest, ARunThatWasKilledBeforeItsReportEndsOnce) {
    const fs::path output = run(scene(), "run");
    const auto before = tree(output);
    std::ofstream(output / "status.json") << R"({"phase": "extension"})"; // the end comes last
    EXPECT_EQ(call_run(output, {"--resume"}).code, 0);
    EXPECT_THAT(contents(output / "status.json"), HasSubstr("\"finished\""));
    EXPECT_EQ(summary(output)["finished"], true);
    EXPECT_EQ(tree(output).size(), before.size());
}

TEST_F(RunTest, ARunShorterThanAThousandthOfADiscGoesOn) {
    const Scene tiny = scene({"extension.distance_m=0.01", "extension.rate_m_per_a=1e-6",
                              "extension.speed_m_per_s=1e-4", "output.interval_m=0.0005"});
    run(tiny, "tiny", {.until = 0.001});
    const fs::path output = run(tiny, "tiny", {.until = {}, .resume = true});
    EXPECT_NEAR(summary(output)["extension_m"].get<double>(), 0.01, 1e-4);
}

TEST_F(RunTest, MomentsNearOneSnapshotAreMeasuredEachAndThoseBeyondTheEndAreNot) {
    const fs::path output = run(scene(), "run");
    const double end = summary(output)["extension_m"];
    const double at[] = {end - 1.0, end, end + 5e3};
    const auto found = examine_run(output, at);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].first, end - 1.0);
    EXPECT_EQ(found[1].first, end);
    EXPECT_EQ(found[0].second, found[1].second);
}

TEST_F(RunTest, ResumeWithNothingThereStartsFromTheBeginning) {
    const fs::path whole = run(scene(), "whole");
    expect_same_run(run(scene(), "resumed", {.resume = true}), whole);
}

TEST_F(RunTest, ResumeWithOtherParametersIsRefusedByName) {
    const fs::path output = run(scene(), "run", {.until = 60.0});
    const auto before = tree(output);
    for (const std::string change : {"cycle.damping=0.5", "sedimentation.level_m=-10", "seed=2"}) {
        const Ended ended = call_run(output, {"--resume", "--set", change});
        EXPECT_EQ(ended.code, 2) << ended.err;
        const std::string key = change.substr(change.find('.') + 1);
        EXPECT_THAT(ended.err, HasSubstr(key.substr(0, key.find('='))));
    }
    const Ended without = call_run(output, {"--resume", "--without", "compaction"});
    EXPECT_EQ(without.code, 2);
    EXPECT_THAT(without.err, HasSubstr("compaction"));
    EXPECT_TRUE(tree(output) == before);
}

TEST_F(RunTest, ResumeOfAFinishedRunWithOtherParametersIsRefusedToo) {
    const fs::path output = run(scene(), "run", {.until = 60.0});
    const Ended ended =
        call_run(output, {"--resume", "--until", "60m", "--set", "cycle.damping=0.5"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("damping"));
}

TEST_F(RunTest, ResumeDoesNotMindOtherComments) {
    const fs::path output = run(scene(), "run", {.until = 60.0});
    std::string text = contents(output / "scene.toml");
    text.replace(text.find("# local non-viscous"), 19, "# words of yesterday, \"or so\"");
    write(output / "scene.toml", text);
    EXPECT_EQ(call_run(output, {"--resume", "--until", "60m"}).code, 0);
}

// -------------------------------------------------------------------------------------- damaged

/// Ways to damage a file that leave no good snapshot of it.
const std::map<std::string, std::function<void(std::string&)>> damages = {
    {"empty", [](std::string& bytes) { bytes.clear(); }},
    {"half of it", [](std::string& bytes) { bytes.resize(bytes.size() / 2); }},
    {"last byte missing", [](std::string& bytes) { bytes.pop_back(); }},
    {"garbage", [](std::string& bytes) { std::ranges::fill(bytes, 'x'); }},
    {"beginning overwritten", [](std::string& bytes) { std::fill_n(bytes.begin(), 4096, '\xff'); }},
};

void damage(const fs::path& file, const std::function<void(std::string&)>& how) {
    std::string bytes = contents(file);
    how(bytes);
    write(file, bytes);
}

TEST_F(RunTest, InsteadOfADamagedSnapshotTheOneBeforeIsUsed) {
    const fs::path whole = run(scene(), "whole");
    const fs::path half = run(scene(), "half", {.until = 160.0});
    for (const auto& [name, how] : damages) {
        SCOPED_TRACE(name);
        const fs::path output = folder / name;
        fs::copy(half, output, fs::copy_options::recursive);
        const std::vector<fs::path> snapshots = list_snapshots(output);
        const fs::path last = snapshots.back(), before = snapshots[snapshots.size() - 2];
        damage(last, how);
        const Ended resumed = call_run(output, {"--resume"});
        EXPECT_EQ(resumed.code, 0);
        EXPECT_THAT(resumed.err, AllOf(HasSubstr("warning"), HasSubstr(last.string()),
                                       HasSubstr("from " + before.string())));
        expect_same_run(output, whole);
    }
}

TEST_F(RunTest, WithoutAnyGoodSnapshotTheRunBeginsAgain) {
    const fs::path whole = run(scene(), "whole", {.until = 100.0});
    const fs::path output = run(scene(), "run", {.until = 60.0});
    auto how = damages.begin();
    for (const fs::path& snapshot : list_snapshots(output))
        damage(snapshot, (how++)->second);
    const Ended resumed = call_run(output, {"--resume", "--until", "100m"});
    EXPECT_EQ(resumed.code, 0);
    EXPECT_THAT(resumed.err, HasSubstr("warning"));
    expect_same_run(output, whole);
}

TEST_F(RunTest, ADamagedSnapshotIsNeverTakenForAnotherState) {
    const fs::path output = run(scene(), "run", {.until = 130.0});
    const fs::path file = list_snapshots(output).back();
    const std::string bytes = contents(file);
    const Snapshot good = read_snapshot(file);
    std::mt19937 random(1);
    int wrong = 0;
    for (int k = 0; k < 200; ++k) {
        std::string damaged = bytes;
        damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
        write(file, damaged);
        try {
            const Snapshot read = read_snapshot(file);
            wrong +=
                hash(read.state) != hash(good.state) || read.event_applied != good.event_applied;
            for (const auto& [event, memory] : good.event_memory)
                wrong += !same(memory, read.event_memory.at(event));
        } catch (const StorageError&) {
            // Just so.
        }
    }
    EXPECT_EQ(wrong, 0) << "of 200 snapshots with one flipped bit";
}

TEST_F(RunTest, DamageIsNoticedBeforeHdf5ReadsTheFile) {
    const fs::path output = run(scene(), "run", {.until = 60.0});
    const fs::path file = list_snapshots(output).back();
    const std::string bytes = contents(file);
    constexpr std::size_t mark = 24; // with the sum
    for (std::size_t at = 0; at < bytes.size() - mark; at += 1 + bytes.size() / 100) {
        std::string damaged = bytes;
        damaged[at] ^= 4;
        write(file, damaged);
        try {
            read_snapshot(file);
            ADD_FAILURE() << "byte " << at;
        } catch (const StorageError& error) {
            EXPECT_THAT(error.what(), HasSubstr("checksum"));
        }
    }
    write(file, bytes.substr(0, bytes.size() - mark));
    EXPECT_THROW(read_snapshot(file), StorageError);
    write(file, bytes);
    EXPECT_NO_THROW(read_snapshot(file));
}

TEST_F(RunTest, ADamagedLastSnapshotIsReplacedInTheEnd) {
    const fs::path output = run(scene(), "run", {.until = 133.7});
    fs::remove(output / "summary.json");
    write(list_snapshots(output).back(), "not a snapshot");
    run(scene(), "run", {.until = 133.7, .resume = true});
    EXPECT_NO_THROW(read_snapshot(list_snapshots(output).back()));
}

TEST_F(RunTest, ASnapshotOfAnotherFormatIsRefusedAndTheRunIsKept) {
    const fs::path output = run(scene(), "run", {.until = 133.7});
    fs::remove(output / "summary.json");
    for (const auto& [digit, cure] : {std::pair{'4', "that version"}, {'9', "a newer program"}}) {
        for (const fs::path& file : list_snapshots(output)) {
            std::string text = contents(file);
            const auto at = text.find("listric snapshot ");
            ASSERT_NE(at, std::string::npos);
            text[at + std::strlen("listric snapshot ")] = digit;
            std::vector<std::byte> bytes(text.size() - 24); // without the checksum
            std::memcpy(bytes.data(), text.data(), bytes.size());
            append_checksum(bytes);
            write(file, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        }
        const auto before = tree(output / "snapshots");
        const Ended refused = call_run(output, {"--resume", "--until", "133.7m"});
        EXPECT_EQ(refused.code, 2);
        EXPECT_THAT(refused.err, AllOf(HasSubstr(std::string("format ") + digit),
                                       HasSubstr("reads formats 5 to 8"), HasSubstr("version"),
                                       HasSubstr(cure)));
        EXPECT_TRUE(tree(output / "snapshots") == before);
    }
}

// --------------------------------------------------------------------------------- output folder

TEST_F(RunTest, AFinishedRunIsReplacedOnlyByForce) {
    const fs::path output = run(scene(), "run", {.until = 100.0});
    const auto before = tree(output);
    const Ended refused = call_run(output);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, AllOf(HasSubstr(output.string()), HasSubstr("finished"),
                                   HasSubstr("--resume"), HasSubstr("--force")));
    EXPECT_TRUE(tree(output) == before);

    EXPECT_EQ(call_run(output, {"--force", "--seed", "2", "--until", "60m"}).code, 0);
    expect_same_run(output, run(scene({"seed=2"}), "new", {.until = 60.0}));
    EXPECT_EQ(names_ending(output, ".h5"), names_ending(folder / "new", ".h5"));
}

TEST_F(RunTest, ForceRemovesOnlyWhatARunMade) {
    const fs::path output = folder / "thesis";
    write(output / "figures/map.png", "years of work");
    write(output / "snapshots/holiday.jpg", "sea");
    const Ended over_nothing = call_run(output, {"--force", "--until", "0"});
    EXPECT_EQ(contents(output / "figures/map.png"), "years of work") << over_nothing.err;
    EXPECT_EQ(contents(output / "snapshots/holiday.jpg"), "sea");
}

TEST_F(RunTest, PartFilesOfOtherProgramsStay) {
    const fs::path output = folder / "home";
    write(output / "Downloads/debian.iso.part", "half of it");
    call_run(output, {"--until", "0"});
    EXPECT_EQ(contents(output / "Downloads/debian.iso.part"), "half of it");
}

TEST_F(RunTest, UnwritableOutputIsAStorageFailure) {
    write(folder / "file", "in the way");
    write(folder / "no snapshots/snapshots", "in the way");
    for (const fs::path& output :
         {folder / "file", folder / "file/below", folder / "no snapshots", fs::path("/proc/run")}) {
        const Ended ended = call_run(output);
        EXPECT_EQ(ended.code, 4) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(output.string()));
        EXPECT_TRUE(ended.err.find("ot a directory") != std::string::npos ||
                    ended.err.find("o such file") != std::string::npos)
            << ended.err;
    }
    EXPECT_EQ(contents(folder / "file"), "in the way");
}

TEST_F(RunTest, AFolderInAFilesPlaceIsAStorageFailure) {
    const fs::path second = list_snapshots(run(scene(), "whole", {.until = 60.0}))[1];
    for (const std::string& name :
         {std::string("history.csv"), "snapshots/" + second.filename().string()}) {
        const fs::path output = folder / fmt::format("blocked {}", fs::path(name).stem().string());
        write(output / name / "inside", "");
        const Ended ended = call_run(output);
        EXPECT_EQ(ended.code, 4) << ended.err;
        EXPECT_THAT(ended.err,
                    AllOf(HasSubstr((output / name).string()), HasSubstr("s a directory")));
        EXPECT_THAT(names_ending(output, ".part"), IsEmpty()) << name;
    }
}

TEST_F(RunTest, AFullDiskKeepsTheLastGoodSnapshot) {
    const fs::path whole = run(scene(), "whole");
    for (const rlim_t size : {100000u, 20000u, 4000u}) {
        SCOPED_TRACE(size);
        const fs::path output = run(scene(), fmt::format("size {}", size), {.until = 100.0});
        const auto before = list_snapshots(output);
        // For a file that grows too large, write() fails as it does on a full disk.
        const Ended ended = call_run(output, {"--resume"}, [size] {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{size, size};
            setrlimit(RLIMIT_FSIZE, &limit);
        });
        EXPECT_EQ(ended.code, 4) << ended.err;
        EXPECT_THAT(ended.err,
                    AllOf(HasSubstr((output / "snapshots").string()), HasSubstr("too large"),
                          HasSubstr("last good state is " + before.back().string()),
                          HasSubstr("resume with: ")));
        EXPECT_EQ(list_snapshots(output), before);
        EXPECT_THAT(names_ending(output, ".part"), IsEmpty());
        expect_whole_files(output);
        run(scene(), output.filename(), {.resume = true});
        expect_same_run(output, whole);
    }
}

TEST_F(RunTest, NobodyNeedsToListen) {
    const fs::path whole = run(scene(), "whole");
    const Ended full =
        call_run(folder / "full", {}, [] { dup2(open("/dev/full", O_WRONLY), STDERR_FILENO); });
    EXPECT_EQ(full.code, 0) << "stderr on a full disk";
    const Ended closed = call_run(folder / "closed", {}, [] {
        for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            close(descriptor);
    });
    EXPECT_EQ(closed.code, 0) << "stderr closed";
    for (const char* name : {"full", "closed"}) {
        ASSERT_TRUE(fs::exists(folder / name / "summary.json")) << name;
        expect_same_run(folder / name, whole);
    }
}

TEST_F(RunTest, OutputThatCannotBeDeliveredIsAStorageFailure) {
    const auto to_full_disk = [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); };
    EXPECT_EQ(call({"scenes"}, to_full_disk).code, 4);
    EXPECT_EQ(call({"explain", "--parameters"}, to_full_disk).code, 4);
    EXPECT_EQ(call({"bench", "--steps", "1"}, to_full_disk).code, 4);
}

// --------------------------------------------------------------------------------- bad scenes

struct BadScene {
    std::string name;
    std::string remove, insert; ///< the change to the small scene
    std::vector<std::string> said;
};

TEST_F(RunTest, ABadSceneIsRefusedBeforeAnythingIsCreated) {
    const std::vector<BadScene> cases = {
        {"misspelt key",
         "mean_radius_m",
         "mean_radios_m",
         {":4: hanging_wall.mean_radios_m: unknown key", "did you mean mean_radius_m?"}},
        {"misspelt table",
         "[compaction]",
         "[compacton]",
         {":23: compacton: unknown table", "did you mean compaction?"}},
        {"wrong type",
         "= 50.0\n[det",
         "= \"fifty\"\n[det",
         {":4: hanging_wall.mean_radius_m: wrong type (string \"fifty\")", "allowed: number"}},
        {"out of range",
         "= 4000.0",
         "= -4000.0",
         {":2: hanging_wall.length_m: out of range (-4000)",
          "allowed: at least 0.001, at most 1e6"}},
        {"not a number",
         "= 4000.0",
         "= nan",
         {":2: hanging_wall.length_m: out of range (nan)", "allowed: at least 0.001"}},
        {"missing table",
         "[sedimentation]\ninterval_a = 6000.0\n",
         "",
         {":21: compaction: needs [sedimentation]", "leave out [compaction]"}},
        {"too few discs",
         "= 50.0\n[det",
         "= 200.0\n[det",
         {":4: hanging_wall.mean_radius_m: too large (200)", "allowed: at most"}},
        {"not TOML", "[gravity]", "[gravity", {":14:"}},
        {"empty", small_scene, "", {": is empty", "[hanging_wall]"}},
        {"binary", "[gravity]", std::string(1, '\0'), {":14: is not a text file"}},
    };
    for (const BadScene& bad : cases) {
        std::string text = small_scene;
        const std::size_t at = text.find(bad.remove);
        ASSERT_NE(at, std::string::npos) << bad.name;
        text.replace(at, bad.remove.size(), bad.insert);
        write(scene_file, text);
        const Ended ended = call_run(folder / "run");
        EXPECT_EQ(ended.code, 2) << bad.name;
        EXPECT_THAT(ended.err, StartsWith("listric: " + scene_file.string() + ":")) << bad.name;
        for (const std::string& words : bad.said)
            EXPECT_THAT(ended.err, HasSubstr(words)) << bad.name;
        EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
        EXPECT_FALSE(fs::exists(folder / "run")) << bad.name;
    }
}

TEST_F(RunTest, ABadCallIsRefusedBeforeAnythingIsCreated) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--until", "5miles"}, "--until 5miles"},
        {{"--until", "-5"}, "--until -5"},
        {{"--until", "nan"}, "--until nan"},
        {{"--until", ""}, "--until"},
        {{"--untill", "5km"}, "no option --untill; did you mean --until?"},
        {{"--threads", "0"}, "--threads"},
        {{"--seed", "one"}, "--seed"},
        {{"--seed", "-1"}, "--seed -1"},
        {{"--accuracy", "perfect"}, "allowed: draft, standard, fine, sandbox"},
        {{"--without", "sedimentaton"}, "did you mean sedimentation?"},
        {{"--without", "extension"}, "is not an effect"},
        {{"--set", "gravity"}, "needs the form table.key=value"},
        {{"--set", "cycle.dampin=0.5"}, "did you mean damping?"},
        {{"--set", "cycle.damping=half"}, "--set cycle.damping=half"},
        {{"--set", "damping=0.5"}, "did you mean cycle.damping?"},
    };
    for (const auto& [words, said] : cases) {
        const Ended ended = call_run(folder / "run", words);
        EXPECT_EQ(ended.code, 2) << fmt::format("{}", words);
        EXPECT_THAT(ended.err, HasSubstr(said)) << fmt::format("{}", words);
        EXPECT_FALSE(fs::exists(folder / "run")) << fmt::format("{}", words);
        fs::remove_all(folder / "run");
    }
    const Ended missing = call({"run", (folder / "nowhere.toml").string()});
    EXPECT_EQ(missing.code, 2);
    EXPECT_THAT(missing.err, HasSubstr("nowhere.toml: no such file"));
    EXPECT_EQ(call({}).code, 2);
    EXPECT_EQ(call({"rnu"}).code, 2);
    EXPECT_THAT(call({"rnu"}).err, HasSubstr("did you mean run?"));
    EXPECT_THAT(call({"--hlep"}).err, HasSubstr("did you mean --help?"));
    EXPECT_EQ(call({"figures", (folder / "nowhere").string()}).code, 2);
}

// --------------------------------------------------------------------------------- out of control

TEST_F(RunTest, AnUnstableTimeStepIsANumericalFailure) {
    const Ended ended = call_run(folder / "run", {"--set", "cycle.time_step_safety=8"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, AllOf(testing::ContainsRegex("disc [0-9]+ ran away at x = .*, y = "),
                                 HasSubstr("time_step_safety")));
}

TEST_F(RunTest, ARunawayLeavesTheLastGoodSnapshot) {
    const fs::path output = run(scene(), "run", {.until = 100.0});
    const auto before = list_snapshots(output);
    change_state(before.back(), [](State& state) { state.clock.time_step *= 10.0; });
    const Ended ended = call_run(output, {"--resume"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, AllOf(testing::ContainsRegex("disc [0-9]+ ran away at x = .*, y = "),
                                 HasSubstr(before.back().string())));
    EXPECT_EQ(list_snapshots(output), before);
    expect_whole_files(output);
}

TEST_F(RunTest, NothingIsSavedAfterANumberWentBad) {
    const std::string often = "output.interval_m=5";
    const fs::path output = run(scene({often}), "run", {.until = 100.0});
    // The direction from one disc to another in the same place is not a number.
    change_state(list_snapshots(output).back(), [](State& state) {
        const DiscColumns d = disc_columns(state);
        const auto first = static_cast<std::size_t>(contact_columns(state).first[0]);
        const auto second = static_cast<std::size_t>(contact_columns(state).second[0]);
        d.x[second] = d.x[first];
        d.y[second] = d.y[first];
        d.vx[second] = d.vx[first];
        d.vy[second] = d.vy[first];
    });
    const Ended ended = call_run(output, {"--resume", "--set", often});
    EXPECT_EQ(ended.code, 3) << ended.err;
    EXPECT_THAT(ended.err, testing::ContainsRegex("disc [0-9]+"));
    for (const fs::path& snapshot : list_snapshots(output))
        EXPECT_TRUE(all_finite(read_snapshot(snapshot).state.discs)) << snapshot;
}

// --------------------------------------------------------------------------------------- effects

TEST_F(RunTest, EffectsThatAreOffCostNothing) {
    const std::vector<std::string> effects = {"gravity",      "bonds",         "fault_weakening",
                                              "bond_healing", "sedimentation", "compaction"};
    const fs::path output = run(scene({}, effects), "run", {.until = 60.0});
    const Snapshot snapshot = read_snapshot(list_snapshots(output).back());
    const auto names = [](const Table& table) {
        std::set<std::string> set;
        for (const Column& column : table.columns())
            set.insert(column.name);
        return set;
    };
    std::set<std::string> strain;
    std::ranges::set_difference(names(snapshot.state.discs), names(empty_state().discs),
                                std::inserter(strain, strain.end()));
    EXPECT_THAT(strain, Each(testing::AnyOf("window_x", "window_y", "in_window", "window_strain",
                                            "total_strain", "window_tectonic_strain",
                                            "total_tectonic_strain", "mean_vx", "mean_vy")));
    EXPECT_EQ(names(snapshot.state.contacts), names(empty_state().contacts));
    EXPECT_EQ(names(snapshot.state.base_contacts), names(empty_state().base_contacts));
    const json result = summary(output);
    EXPECT_THAT(result["effects"], IsEmpty());
    for (const std::string& effect : effects) {
        EXPECT_FALSE(snapshot.event_memory.contains(effect)) << effect;
        EXPECT_FALSE(result["time_by_part_s"].contains(effect)) << effect;
    }
    EXPECT_FALSE(snapshot.event_memory.contains("energy"));
    EXPECT_THAT(contents(output / "history.csv"), Not(HasSubstr("energy")));
    for (const char* name : {"weak_fraction", "volume_error_fraction", "depocentres",
                             "quasi_static", "energy_residual", "energy_by_event_j_per_m",
                             "sediment_weak_off_fault_fraction", "basement_unbonded_fraction"})
        EXPECT_FALSE(result.contains(name)) << name;

    const fs::path all = run(scene(), "all", {.until = 60.0});
    const Table discs = read_snapshot(list_snapshots(all).back()).state.discs;
    for (const char* column : {"rock_radius", "rock_area", "scanned_x", "healed_x", "porosity"})
        EXPECT_TRUE(discs.has(column)) << column;
}

// --------------------------------------------------------------------------------------- results

void expect_no_empty_values(const json& value, const std::string& name) {
    EXPECT_FALSE(value.is_null()) << name;
    if (value.is_number_float()) {
        EXPECT_TRUE(std::isfinite(value.get<double>())) << name;
    }
    if (value.is_structured()) {
        for (const auto& [key, inner] : value.items())
            expect_no_empty_values(inner, name + "." + key);
    }
}

TEST_F(RunTest, TheSummaryHasEveryName) {
    const json all = summary(run(scene(), "run"));
    for (const char* name : {"scene",
                             "accuracy",
                             "seed",
                             "threads",
                             "cycle_level",
                             "discs",
                             "cycles",
                             "wall_s",
                             "predicted_wall_s",
                             "disc_steps_per_s",
                             "finished",
                             "state_hash",
                             "extension_m",
                             "unbalanced_ratio_mean",
                             "unbalanced_ratio_max",
                             "inertial_number",
                             "quasi_static",
                             "effects",
                             "time_by_part_s",
                             "basin_area_m2",
                             "area_balance",
                             "cutoff_x_m",
                             "cutoff_z_m",
                             "rollover_tilt_deg",
                             "strain_top10",
                             "strain_top10_cumulative",
                             "strain_gini",
                             "basement_unbonded_fraction",
                             "weak_fraction",
                             "volume_error_fraction",
                             "deposited_fraction",
                             "eroded_fraction",
                             "mass_error_fraction",
                             "depocentres",
                             "faults"})
        EXPECT_TRUE(all.contains(name)) << name;
    EXPECT_EQ(all["scene"], "small");
    EXPECT_EQ(all["finished"], true);
    for (const char* part : {"genesis", "rebuild", "cycle", "fault_weakening", "bond_healing",
                             "sedimentation", "compaction", "output", "figures", "other"})
        EXPECT_TRUE(all["time_by_part_s"].contains(part)) << part;
    expect_no_empty_values(all, "summary");
    expect_no_empty_values(summary(run(scene(), "at rest", {.until = 0.0})), "summary at rest");
}

TEST_F(RunTest, ErosionToAFallingLineIsAccountedForAndResumes) {
    write(folder / "falling.csv", "time_a,x_m,y_m\n0,0,0\n30000,0,-300\n30000,4000,-100\n");
    const Scene what = scene({"sedimentation.target_csv=" + (folder / "falling.csv").string()});
    const fs::path whole = run(what, "whole");
    const json all = summary(whole);
    EXPECT_GT(all["eroded_fraction"].get<double>(), 0.03);
    EXPECT_LT(all["eroded_fraction"].get<double>(), 0.25);
    // Sums of some thousand masses are rounded: 1e-16 each.
    EXPECT_LT(all["mass_error_fraction"].get<double>(), 1e-13);
    const State state = read_snapshot(list_snapshots(whole).back()).state;
    const ConstDiscColumns d = disc_columns(state);
    const TargetLine line({{0.0, -300.0}, {4000.0, -100.0}});
    for (std::size_t i = 0; i < d.x.size(); ++i)
        EXPECT_LT(line.above({d.x[i], d.y[i]}), d.radius[i] + state.mean_radius) << d.x[i];
    // The written scene stands alone: the file may be gone when it is resumed.
    run(what, "parts", {.until = 130.0});
    fs::remove(folder / "falling.csv");
    const Scene again = load_scene({.scene = (folder / "parts/scene.toml").string()});
    expect_same_run(whole, run(again, "parts", {.resume = true}));
}

TEST_F(RunTest, NoDiscLeavesAKinkedDetachment) {
    // Kinks of both kinds, sharp, and an inclined breakaway: 1500 m deep in all.
    const std::vector<std::string> kinked{
        "detachment.start_dip_deg=60",
        "detachment.segments=[{line={length_m=600}}, {line={length_m=600, start_dip_deg=5}}, "
        "{line={length_m=1036.71, start_dip_deg=65}}, "
        "{line={length_m=100, start_dip_deg=0}}]",
        "hanging_wall.thickness_m=1511.5"};
    const Scene what = scene(kinked);
    const fs::path output = run(what, "run");
    const RigidBase base = make_rigid_base(what);
    const State state = read_snapshot(list_snapshots(output).back()).state;
    const ConstDiscColumns d = disc_columns(state);
    const Chain& detachment = base.surfaces.front().chain;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const auto foot = nearest(detachment, {d.x[i], d.y[i]});
        EXPECT_TRUE(foot || (d.x[i] > 0.0 && d.y[i] > -100.0)) << d.x[i] << " " << d.y[i];
        if (foot) {
            EXPECT_GT(foot->distance, 0.3 * d.radius[i]) << d.x[i] << " " << d.y[i];
        }
    }
    const json all = summary(output);
    EXPECT_TRUE(all.contains("rollover_tilt_deg"));
    EXPECT_FALSE(all.contains("toe_rotation_deg")); // 5 degrees are no flat
}

TEST_F(RunTest, TheHistoryEndsWhereTheSummaryDoes) {
    const fs::path output = run(scene(), "run");
    std::istringstream lines(contents(output / "history.csv"));
    std::vector<std::vector<std::string>> rows;
    for (std::string line, cell; std::getline(lines, line);) {
        std::istringstream cells(line);
        for (rows.emplace_back(); std::getline(cells, cell, ',');)
            rows.back().push_back(cell);
        if (line.ends_with(','))
            rows.back().emplace_back(); // no number
    }
    ASSERT_THAT(rows, SizeIs(1 + 7)); // names; 0, 50, ..., 300 m
    const json all = summary(output);
    for (std::size_t k = 0; k < rows[0].size(); ++k) {
        ASSERT_LT(k, rows.back().size());
        if (const std::string& name = rows[0][k]; all.contains(name)) {
            EXPECT_EQ(std::stod(rows.back()[k]), all[name].get<double>()) << name;
        }
    }
    EXPECT_THAT(rows[0], AllOf(Contains("extension_m"), Contains("basin_area_m2"),
                               Contains("rollover_tilt_deg"), Contains("volume_error_fraction")));
}

TEST_F(RunTest, TheTimeIsAccountedFor) {
    const auto start = std::chrono::steady_clock::now();
    const fs::path output = folder / "run";
    for (const char* until : {"150m", "300m"}) {
        ASSERT_EQ(call_run(output, {"--set", slowly, "--until", until, "--resume"}).code, 0);
        const json all = summary(output);
        const double wall = all["wall_s"].get<double>();
        double sum = 0.0;
        for (const auto& [part, seconds] : all["time_by_part_s"].items()) {
            EXPECT_GE(seconds.get<double>(), 0.0) << part;
            sum += seconds.get<double>();
        }
        EXPECT_NEAR(sum, wall, std::max(0.2, 0.02 * wall));
        const double measured =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        EXPECT_LE(wall, measured);
        EXPECT_GE(wall, 0.5 * measured);
    }
}

// --------------------------------------------------------------------------------------- figures

TEST_F(RunTest, FiguresAreDrawnAndRedrawn) {
    unsetenv("LISTRIC_PYTHON");
    const fs::path output = run(scene(), "run", {.until = 130.0});
    EXPECT_THAT(contents(output / "log.txt"), Not(HasSubstr("warning: no figures")));
    const auto drawn = names_ending(output / "figures", ".png");
    EXPECT_THAT(drawn, Contains(StartsWith("overview-")));
    fs::remove_all(output / "figures");
    const Ended ended = call({"figures", output.string()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(names_ending(output / "figures", ".png"), drawn);
    EXPECT_THAT(contents(output / "figures/caption.txt"), StartsWith("strata-0.13km\n"));
    for (const char* text : {"caption.txt", "origin.txt"})
        EXPECT_TRUE(fs::remove(output / "figures" / text)) << text;
    for (const auto& [path, file] : tree(output / "figures"))
        EXPECT_THAT(file.first, AllOf(StartsWith("\x89PNG"), HasSubstr("IEND"))) << path;
}

TEST_F(RunTest, FiguresInEveryFormatTellTheirRunAndAreTheSameAgain) {
    unsetenv("LISTRIC_PYTHON");
    const fs::path output = run(scene(), "run", {.until = 130.0});
    const std::string png = contents(output / "figures/strata-0.13km.png");
    std::map<std::string, std::string> before;
    for (int time = 0; time < 2; ++time) {
        const Ended ended = call({"figures", output.string(), "--format", "png,pdf,svg"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        for (const auto& [format, begin] :
             {std::pair{"png", "\x89PNG"}, {"pdf", "%PDF"}, {"svg", "<?xml"}}) {
            const std::string text =
                contents(output / fmt::format("figures/strata-0.13km.{}", format));
            EXPECT_THAT(text, StartsWith(begin));
            EXPECT_THAT(text, HasSubstr(summary(output)["provenance"]["scene_hash"]));
            EXPECT_TRUE(time == 0 || text == before[format]) << format;
            before[format] = text;
        }
    }
    EXPECT_EQ(before["png"], png);
    const Ended ended = call({"figures", output.string(), "--format", "png,pfd"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("no format pfd; did you mean pdf?"));
}

TEST_F(RunTest, AnimationAndSheetOfSeveralMoments) {
    unsetenv("LISTRIC_PYTHON");
    const fs::path output = run(scene({"output.figures_at_m=[20, 40]"}), "run", {.until = 60.0});
    const auto drawn = names_ending(output / "figures", ".png");
    EXPECT_THAT(drawn, Contains(StartsWith("experiment-")));
    const Ended ended = call({"figures", output.string(), "--animation"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(names_ending(output / "figures", ".png"), drawn);
    EXPECT_EQ(names_ending(output / "figures", ".gif").size() +
                  names_ending(output / "figures", ".mp4").size(),
              1u);
    // Neither survives the run that replaces this one.
    run(scene(), "run", {.until = 20.0, .force = true});
    EXPECT_THAT(names_ending(output / "figures", ".gif"), IsEmpty());
    EXPECT_THAT(names_ending(output / "figures", ".mp4"), IsEmpty());
}

TEST_F(RunTest, WithoutMatplotlibARunWarnsAndFinishes) {
    const Ended ended = call_run(folder / "run", {"--until", "20m"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("warning"), HasSubstr("matplotlib")));
    EXPECT_EQ(summary(folder / "run")["finished"], true);
    EXPECT_THAT(names_ending(folder / "run/figures", ""), IsEmpty());
}

TEST_F(RunTest, TheEndIsDrawnEvenCloseToAnotherFigure) {
    // The stand-in for Python makes every attempt to draw a warning.
    const Scene close = scene({"output.figures_at_m=[100]"});
    const fs::path output = run(close, "run", {.until = 90.0});
    EXPECT_THAT(contents(output / "log.txt"), HasSubstr("no figures"));
}

// ----------------------------------------------------------------------------------------- bench

TEST_F(RunTest, BenchPrintsOneObject) {
    std::string packing = "# two layers\n6 700 500 8.5e10 3.19e10 0.5 3042 9.81\n\n";
    for (const char* disc : {"100 100", "300 100", "500 100", "200 273", "400 273", "600 273"})
        packing += fmt::format("{} 100.1\n", disc);
    write(folder / "packing.txt", packing);
    const std::string file = (folder / "packing.txt").string();
    const Ended ended = call({"bench", "--packing", file, "--steps", "300"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    const json result = json::parse(ended.out);
    EXPECT_THAT(result, SizeIs(7));
    EXPECT_EQ(result["discs"], 6);
    EXPECT_EQ(result["contacts"], 9);
    EXPECT_EQ(result["steps"], 300);
    EXPECT_TRUE(result["threads"].is_number_integer());
    EXPECT_GT(result["disc_steps_per_s"].get<double>(), 0.0);
    EXPECT_GT(result["disc_steps_per_cpu_s"].get<double>(), 0.0);
}

TEST_F(RunTest, TheEnvironmentNamesTheCycle) {
    const auto bench_with = [&](std::string_view cycle) {
        return call({"bench", "--discs", "10", "--steps", "1"},
                    [=] { setenv("LISTRIC_CYCLE", std::string(cycle).c_str(), 1); });
    };
    for (const Cycle cycle : cycles()) {
        const Ended ended = bench_with(name(cycle));
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(json::parse(ended.out)["cycle_level"], name(cycle));
    }
    const Ended ended = bench_with("v5");
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("LISTRIC_CYCLE: this processor has no cycle 'v5'; "
                                     "there are plain, baseline"));
}

TEST_F(RunTest, BenchNamesTheLineOfAMalformedPacking) {
    const std::string header = "2 40 40 8.5e10 3.19e10 0.5 3042 9.81\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", ":0: the header"},
        {"# only a comment\n", ":1: the header"},
        {"2 40 40\n", ":1: the header"},
        {"1e30 40 40 8.5e10 3.19e10 0.5 3042 9.81\n", ":1: the header"},
        {"-2 40 40 8.5e10 3.19e10 0.5 3042 9.81\n", ":1: the header"},
        {header + "10 10 10\n\n30 x 10\n", ":4: disc 2 of 2"},
        {header + "10 10 10\n30 10 -10\n", ":3: disc 2 of 2"},
        {header + "10 10 10\n", ":2: disc 2 of 2"},
        {header + "10 10 10\n30 10 10\n50 10 10\n", ":4:"},
    };
    const std::string file = (folder / "packing.txt").string();
    for (const auto& [text, said] : cases) {
        write(file, text);
        const Ended ended = call({"bench", "--packing", file, "--steps", "10"});
        EXPECT_EQ(ended.code, 2) << text;
        EXPECT_THAT(ended.err, HasSubstr(file + said)) << text;
        EXPECT_EQ(ended.out, "") << text;
    }
}

} // namespace
} // namespace listric::run_test
