// An output in one place: one that the program does not have, handed in by its line of a list, is
// told of a run's moments as the program's own are.

#include "apps/run/run_view.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <map>
#include <utility>

namespace listric::own_output_test {

using namespace support;
using testing::HasSubstr;
using testing::Not;

namespace {

std::string diary; // what it has been told; also in diary.txt

std::string take() { return std::exchange(diary, ""); }

std::optional<Output> keep_diary(const RunView& of) {
    if (!of.options.report)
        return std::nullopt;
    const auto told = [](const std::string& what) {
        return [what](RunView& run) {
            diary += fmt::format("{} {:.0f}\n", what, run.extension().m);
            std::ofstream(run.options.output / "diary.txt") << diary;
        };
    };
    const auto finish = [=](RunView& run) {
        told("finish")(run);
        run.numbers.emplace_back("diary_bytes", static_cast<double>(diary.size()));
    };
    const auto close = [=](RunView& run) {
        EXPECT_EQ(contents(run.options.output / "summary.json"), run.summary); // it comes before
        told("close")(run);
    };
    return Output{
        .part = Part::report,
        .enter =
            [=](RunView& run) { told(fmt::format("phase {}", static_cast<int>(run.phase)))(run); },
        .begin = told("begin"),
        .resume = told("resume"),
        .window = told("window"),
        .save = told("save"),
        .finish = finish,
        .close = close};
}

/// The program's outputs and the diary.
OutputList outputs_and_diary() {
    static const std::vector<MakeOutput> list = [] {
        std::vector<MakeOutput> all(program_outputs().begin(), program_outputs().end());
        all.push_back(keep_diary);
        return all;
    }();
    return list;
}

class OwnOutput : public SceneRuns {
protected:
    OwnOutput() { take(); }

    static Scene scene() { return load_scene({.scene = test_scene("every-effect.toml")}); }

    RunOptions until(double extension, bool resume) const {
        RunOptions o = options("run");
        o.figures = false;
        o.until = extension;
        o.resume = resume;
        return o;
    }
};

TEST_F(OwnOutput, IsToldOfARunsMomentsAndAddsToItsSummary) {
    const RunOptions o = until(100.0, false);
    ASSERT_EQ(run_scene(scene(), o, outputs_and_diary()), RunOutcome::finished);
    EXPECT_EQ(take(), "phase 0 0\nbegin 0\nphase 1 0\nwindow 50\nwindow 100\nfinish 100\n"
                      "close 100\nphase 3 100\n");
    const auto with = nlohmann::json::parse(contents(o.output / "summary.json"));
    EXPECT_EQ(with["diary_bytes"], 60);
    EXPECT_TRUE(with["time_by_part_s"].contains("report"));

    const auto without = run(scene(), "without", 100.0);
    EXPECT_EQ(with["state_hash"], without["state_hash"]);
    EXPECT_FALSE(without.contains("diary_bytes"));
}

TEST_F(OwnOutput, IsToldOfWhatIsSavedWithinAWindowAndResumed) {
    run_scene(scene(), until(70.0, false), outputs_and_diary());
    EXPECT_EQ(take(), "phase 0 0\nbegin 0\nphase 1 0\nwindow 50\nsave 70\nfinish 70\n"
                      "close 70\nphase 3 70\n");
    run_scene(scene(), until(100.0, true), outputs_and_diary());
    EXPECT_EQ(take(), "resume 70\nphase 1 70\nwindow 100\nfinish 100\nclose 100\n"
                      "phase 3 100\n");
}

TEST_F(OwnOutput, IsToldThatTheRunStops) {
    const std::atomic<bool> asked = true;
    RunOptions o = until(100.0, false);
    run_scene(scene(), until(50.0, false)); // genesis would be stopped, too
    take();
    o.resume = true;
    o.stop = StopToken(asked);
    EXPECT_EQ(run_scene(scene(), o, outputs_and_diary()), RunOutcome::interrupted);
    EXPECT_EQ(take(), "resume 50\nphase 1 50\nphase 2 50\n");
    EXPECT_THAT(contents(o.output / "status.json"), HasSubstr("\"stopped\""));
}

TEST_F(OwnOutput, IsNotThereWhereTheRunDoesNotCallForIt) {
    RunOptions o = until(50.0, false);
    o.report = false;
    run_scene(scene(), o, outputs_and_diary());
    EXPECT_EQ(take(), "");
    EXPECT_FALSE(std::filesystem::exists(o.output / "diary.txt"));
    EXPECT_THAT(contents(o.output / "summary.json"), Not(HasSubstr("\"report\":")));
}

TEST_F(OwnOutput, ColumnsOfTheHistoryHaveUnits) {
    const RunOptions o = until(50.0, false);
    run_scene(scene(), o);
    const RunRecord record = read_run_record(list_snapshots(o.output).back());
    std::map<std::string, std::string> units;
    for (const Column& column : record.history.columns())
        units[column.name] = column.unit;
    EXPECT_EQ(units.at("extension_m"), "m");
    EXPECT_EQ(units.at("discs"), "1");
    EXPECT_NE(units.at("basin_area_m2"), "");
    EXPECT_EQ(units.at("rollover_tilt_deg"), "deg");
}

} // namespace
} // namespace listric::own_output_test
