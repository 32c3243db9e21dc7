// Whole runs in trouble: a boundary that moves too fast is reported and flagged, and a
// run that goes wrong stops, names what and where, and leaves a state from which it can go on.

#include "apps/model/effects.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/ranks/subdomain.hpp"
#include "tests/places.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <sys/wait.h>

namespace listric::run_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using namespace support;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class HardRun : public SceneRuns {
protected:
    /// Writes the newest snapshot of a run anew with another state.
    static void change_newest(const fs::path& output, const std::function<void(State&)>& change) {
        const fs::path file = list_snapshots(output).back();
        Snapshot snapshot = read_snapshot(file);
        change(snapshot.state);
        const Scene scene = load_scene({.scene = (output / "scene.toml").string()});
        auto events = make_events(scene, make_parts(scene));
        for (auto& event : events) {
            event->memory = snapshot.event_memory.at(event->name());
            event->applied = snapshot.event_applied.at(event->name());
        }
        write_snapshot(file, snapshot.state, events, snapshot.record);
    }
};

TEST_F(HardRun, HasteIsSaidAndFlagged) {
    // Quasi-static limits: 1e-2 of contact forces unbalanced, inertial number 2e-3. At 0.25 m/s
    // this small hanging wall has a third of both; at 40 m/s ten times as much.
    const auto run_at = [&](const char* speed) {
        const Scene scene =
            load_scene({.scene = test_scene("every-effect.toml"),
                        .set = {std::string("extension.speed_m_per_s=") + speed},
                        .without = {"fault_weakening", "sedimentation", "compaction"}});
        return run(scene, options(speed));
    };
    const nlohmann::json slow = run_at("0.25"), fast = run_at("40");
    EXPECT_EQ(slow["quasi_static"], true)
        << slow["unbalanced_ratio_mean"] << slow["inertial_number"];
    EXPECT_THAT(contents(folder / "0.25/log.txt"), Not(HasSubstr("warning: too fast")));
    EXPECT_EQ(fast["quasi_static"], false);
    EXPECT_THAT(contents(folder / "40/log.txt"),
                AllOf(HasSubstr("warning: too fast to be quasi-static"),
                      HasSubstr("extension.speed_m_per_s")));
}

TEST_F(HardRun, ARunGoneWrongIsNamedAndGoesOnFromItsLastState) {
    const Scene scene = load_scene({.scene = test_scene("every-effect.toml")});
    const nlohmann::json whole = run(scene, options("whole"));
    RunOptions o = options("run");
    o.until = 100.0;
    run(scene, o);
    const auto snapshots = list_snapshots(o.output);
    double time_step = 0.0;
    change_newest(o.output, [&](State& state) {
        time_step = state.clock.time_step;
        state.clock.time_step *= 10.0;
    });
    o.until.reset();
    o.resume = true;
    try {
        run_scene(scene, o);
        FAIL() << "an unstable run went on";
    } catch (const NumericalFailure& failure) {
        EXPECT_THAT(failure.what(), AllOf(ContainsRegex("disc [0-9]+ ran away at x = .*, y = .* m"),
                                          HasSubstr(snapshots.back().string()),
                                          HasSubstr("--set cycle.time_step_safety=0.475 --output"),
                                          HasSubstr("resumed it would end the same way")));
    }
    EXPECT_EQ(list_snapshots(o.output), snapshots);
    EXPECT_FALSE(fs::exists(o.output / "summary.json"));
    const std::string call =
        fmt::format("'{}' run '{}' --output '{}' --resume --quiet 2>/dev/null", program_path,
                    (o.output / "scene.toml").string(), o.output.string());
    EXPECT_EQ(WEXITSTATUS(std::system(call.c_str())), 3);
    // With the time step that it should have had, it ends as if nothing had been.
    change_newest(o.output, [&](State& state) { state.clock.time_step = time_step; });
    EXPECT_EQ(run(scene, o)["state_hash"], whole["state_hash"]);
}

#ifdef LISTRIC_HAS_RANKS
TEST_F(HardRun, RanksEndTogetherWhereDiscsRunAwayOrAreNowhere) {
    const Scene scene = load_scene({.scene = test_scene("every-effect.toml")});
    RunOptions o = options("run");
    o.until = 100.0;
    run(scene, o);
    const fs::path newest = list_snapshots(o.output).back(), kept = folder / "kept.h5";
    fs::copy_file(newest, kept);
    const auto rank_of = [](const State& state, std::size_t row) {
        return ranks_by_rows(state, 2)[row];
    };
    const auto lose = [&](std::int32_t rank) { // a disc of that rank
        return [=](State& state) {
            std::size_t row = 0;
            while (rank_of(state, row) != rank)
                ++row;
            disc_columns(state).vx[row] = std::nan("");
        };
    };
    const std::function<void(State&)> faults[] = {
        [](State& state) { state.clock.time_step *= 10.0; }, lose(0), lose(1)};
    const std::string message = (folder / "message").string();
    for (const auto& fault : faults) {
        fs::copy_file(kept, newest, fs::copy_options::overwrite_existing);
        change_newest(o.output, fault);
        const std::string call = fmt::format(
            "timeout 60 env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
            "/usr/bin/mpirun --oversubscribe --mca mpi_yield_when_idle 1 -n 2 '{}' run '{}' "
            "--output '{}' --resume --quiet >'{}' 2>&1",
            program_path, (o.output / "scene.toml").string(), o.output.string(), message);
        EXPECT_EQ(WEXITSTATUS(std::system(call.c_str())), 3) << contents(message);
        EXPECT_THAT(contents(message), ContainsRegex("disc [0-9]+ ran away"));
    }
}
#endif

TEST_F(HardRun, AnEventThatCannotBeDoneIsNamedToo) {
    const Scene scene = load_scene({.scene = test_scene("every-effect.toml"),
                                    .set = {"sedimentation.target=[{time_a=0, points=[[0, 0]]}, "
                                            "{time_a=1e4, points=[[0, 0]]}, {time_a=1.2e4, "
                                            "points=[[-9e3, 0], [-8e3, -2000], [9e3, -2000]]}]"}});
    const RunOptions o = options("run");
    try {
        run_scene(scene, o);
        FAIL() << "all rock was eroded";
    } catch (const NumericalFailure& failure) {
        EXPECT_THAT(failure.what(), AllOf(HasSubstr("below the whole hanging wall"),
                                          ContainsRegex("extension-00(099|100)[.].*h5")));
    }
    EXPECT_TRUE(all_finite(read_snapshot(list_snapshots(o.output).back()).state.discs));
}

} // namespace
} // namespace listric::run_test
