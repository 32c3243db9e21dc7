// An output in one place: one that the program does not have, handed in by its line of a list, is
// told of a run's moments as the program's own are.

#include "apps/run/run_view.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <map>
#include <utility>

namespace listric {

using namespace support;
using testing::HasSubstr;
using testing::Not;

namespace {

/// What it has been told, in diary.txt.
class Diary : public Output {
public:
    Part part() const override { return Part::report; }

    void enter(RunView& run) override { add(run, fmt::format("phase {}", int(run.phase))); }
    void begin(RunView& run) override { add(run, "begin"); }
    void resume(RunView& run) override { add(run, "resume"); }
    void window(RunView& run) override { add(run, "window"); }
    void save(RunView& run) override { add(run, "save"); }
    void finish(RunView& run) override {
        add(run, "finish");
        append(run.numbers, {{"diary_lines", static_cast<double>(lines)}});
    }
    void close(RunView& run) override {
        EXPECT_EQ(contents(run.options.output / "summary.json"), run.summary); // it comes before
        add(run, "close");
    }

    static std::string take() { return std::exchange(text, ""); }

private:
    void add(const RunView& run, const std::string& what) {
        ++lines;
        text += fmt::format("{} {:.0f}\n", what, run.extension());
        std::ofstream(run.options.output / "diary.txt") << text;
    }

    int lines = 0;
    static inline std::string text;
};

/// The program's outputs and the diary.
OutputList outputs_and_diary() {
    static const std::vector<MakeOutput> list = [] {
        std::vector<MakeOutput> all(program_outputs().begin(), program_outputs().end());
        all.push_back([](const RunView& run) -> std::unique_ptr<Output> {
            return run.options.report ? std::make_unique<Diary>() : nullptr;
        });
        return all;
    }();
    return list;
}

class OwnOutput : public SceneRuns {
protected:
    OwnOutput() { Diary::take(); }

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
    EXPECT_EQ(Diary::take(), "phase 0 0\nbegin 0\nphase 1 0\nwindow 50\nwindow 100\nfinish 100\n"
                             "close 100\nphase 3 100\n");
    const auto with = nlohmann::json::parse(contents(o.output / "summary.json"));
    EXPECT_EQ(with["diary_lines"], 6);
    EXPECT_TRUE(with["time_by_part_s"].contains("report"));

    const auto without = run(scene(), "without", 100.0);
    EXPECT_EQ(with["state_hash"], without["state_hash"]);
    EXPECT_FALSE(without.contains("diary_lines"));
}

TEST_F(OwnOutput, IsToldOfWhatIsSavedWithinAWindowAndResumed) {
    run_scene(scene(), until(70.0, false), outputs_and_diary());
    EXPECT_EQ(Diary::take(), "phase 0 0\nbegin 0\nphase 1 0\nwindow 50\nsave 70\nfinish 70\n"
                             "close 70\nphase 3 70\n");
    run_scene(scene(), until(100.0, true), outputs_and_diary());
    EXPECT_EQ(Diary::take(), "resume 70\nphase 1 70\nwindow 100\nfinish 100\nclose 100\n"
                             "phase 3 100\n");
}

TEST_F(OwnOutput, IsToldThatTheRunStops) {
    const std::atomic<bool> asked = true;
    RunOptions o = until(100.0, false);
    run_scene(scene(), until(50.0, false)); // genesis would be stopped, too
    Diary::take();
    o.resume = true;
    o.stop = StopToken(asked);
    EXPECT_EQ(run_scene(scene(), o, outputs_and_diary()), RunOutcome::interrupted);
    EXPECT_EQ(Diary::take(), "resume 50\nphase 1 50\nphase 2 50\n");
    EXPECT_THAT(contents(o.output / "status.json"), HasSubstr("\"stopped\""));
}

TEST_F(OwnOutput, IsNotThereWhereTheRunDoesNotCallForIt) {
    RunOptions o = until(50.0, false);
    o.report = false;
    run_scene(scene(), o, outputs_and_diary());
    EXPECT_EQ(Diary::take(), "");
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
} // namespace listric
