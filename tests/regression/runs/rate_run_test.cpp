// Runs whose intervals are ways of the wall have equal bits at every geological rate.

#include "dem/event.hpp"
#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <set>

namespace listric::rate_run_test {

using namespace dem;
namespace {

using namespace support;
using testing::HasSubstr;

class RateRun : public SceneRuns {};

std::string rate_is(double rate) { return fmt::format("extension.rate_m_per_a={}", rate); }

/// Small, with every effect whose intervals are ways alone.
const std::string small = small_halfgraben() + R"(
[extension]
distance_m = 600.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 300.0
figures_at_m = []
series = "none"
report = false
[gravity]
[bonds]
[fault_weakening]
least_slip_m = 20.0
heal_after_a = 0.0
)";

TEST_F(RateRun, StatesHaveEqualBitsAtAllRates) {
    const std::string cover = "[bond_healing]\n[sedimentation]\n[compaction]\n";
    for (const std::string& text : {small, small + cover}) {
        std::set<std::string> hashes;
        for (const double rate : {0.01, 0.001, 0.0002, 0.003}) {
            const Scene scene = load(text, {rate_is(rate)});
            hashes.insert(run(scene, fmt::format("run-{}-{}", text.size(), rate))["state_hash"]);
        }
        EXPECT_EQ(hashes.size(), 1u) << text;
    }
    // Stated, the intervals are those of a tenth of the way: another run.
    const nlohmann::json stated =
        run(load(small, {rate_is(0.001), "fault_weakening.interval_a=50000"}), "stated");
    EXPECT_NE(stated["state_hash"], run(load(small, {rate_is(0.001)}), "followed")["state_hash"]);
    ASSERT_EQ(stated["warnings"].size(), 1u);
    EXPECT_THAT(stated["warnings"][0].get<std::string>(), HasSubstr("few faults are found"));
}

TEST_F(RateRun, SoftLayersFollowTheRateWithoutFaultsToo) {
    std::string text = small;
    text.erase(text.find("[fault_weakening]"));
    text += "[[layer]]\nname = \"salt\"\nmaterial = \"salt\"\ntop_m = 700.0\nthickness_m = 400.0\n";
    std::set<std::string> hashes;
    for (const double rate : {0.01, 0.001, 0.003})
        hashes.insert(run(load(text, {rate_is(rate)}), fmt::format("salt-{}", rate))["state_hash"]);
    EXPECT_EQ(hashes.size(), 1u);
}

// An older version sampled the balance of forces every 2,500 a, at 1 mm a year every 2.5 m.
TEST_F(RateRun, ARunThatAnOlderVersionBeganAtALowRateIsSampledOn) {
    const Scene scene = load(small, {rate_is(0.001)});
    run(scene, "begun", 300.0);
    const auto path = list_snapshots(folder / "begun").back();
    Snapshot snapshot = read_snapshot(path);
    snapshot.event_applied.at("equilibrium") *= 10;
    const ModelParts parts = make_parts(scene);
    const Events events = make_events(scene, parts);
    archive::hand_over(snapshot, events, path);
    for (const auto& event : events)
        if (event->name() == "equilibrium") {
            EXPECT_EQ(event->next_due().m, 325.0);
        }
}

// Its record states the intervals that it had.
TEST_F(RateRun, ARunThatAnOlderVersionBeganGoesOnWithItsIntervals) {
    const std::vector<std::string> former{rate_is(0.001), "fault_weakening.interval_a=50000",
                                          "fault_weakening.update_interval_a=2500",
                                          "fault_weakening.youngest_sediment_a=200000",
                                          "fault_weakening.resting_rate_per_s=1e-15"};
    const auto whole = run(load(small, former), "whole");
    run(load(small, former), "begun", 300.0);
    const auto file = folder / "small.toml";
    const Ended ended = Program(folder, {"run", file, "--set", former.front(), "--output",
                                         folder / "begun", "--resume", "--no-report"})
                            .wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("states no intervals: the run goes on with those"));
    EXPECT_EQ(nlohmann::json::parse(contents(folder / "begun/summary.json"))["state_hash"],
              whole["state_hash"]);
}

} // namespace
} // namespace listric::rate_run_test
