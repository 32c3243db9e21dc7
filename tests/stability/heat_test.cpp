// Temperatures where a section is at its ends: bare ground, columns without discs, ground that
// floods everything or sinks far, a pause of 100 Ma in one step, and a way back. In all of them
// heat is booked, flows out, and no disc is colder than the ground or hotter than the lithosphere's
// base.

#include "tests/scene_runs.hpp"
#include "thermal/columns.hpp"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

namespace listric::heat_test {

using namespace dem;
namespace {

using namespace support;
using testing::HasSubstr;

/// Hot ground: 100 degrees lie at 1.4 km, so that sediment ripens.
const std::string rock = small_halfgraben() + R"([output]
interval_m = 50.0
figures_at_m = []
series = "none"
report = false
[gravity]
[bonds]
[heat]
interval_a = 2500
lithosphere_m = 20e3
crust_m = 10e3
)";
constexpr const char* motion = "[extension]\ndistance_m = 200.0\nspeed_m_per_s = 4.0\n";
constexpr const char* staged = "[extension]\nspeed_m_per_s = 4.0\n";
constexpr double base_temperature = 1333.0, surface_temperature = 10.0;

class HeatAtItsEnds : public SceneRuns {
protected:
    nlohmann::json expect_sound(const std::string& text, std::optional<double> until = {},
                                bool resume = false) {
        const nlohmann::json summary = run(load(rock + text), "run", until, resume);
        const State state = read_snapshot(list_snapshots(folder / "run").back()).state;
        EXPECT_TRUE(all_finite(state.discs));
        for (const double t : state.discs.get(thermal::columns::temperature)) {
            EXPECT_GE(t, surface_temperature - 1e-6);
            EXPECT_LE(t, base_temperature);
        }
        EXPECT_LE(std::abs(summary["heat_balance_error"].get<double>()), 1e-10);
        EXPECT_GT(summary["least_heat_flow_mw_per_m2"].get<double>(), 0.0);
        return summary;
    }
};

TEST_F(HeatAtItsEnds, BareGroundAndScarp) { expect_sound(motion); }

TEST_F(HeatAtItsEnds, AColumnThatHasLostAllItsDiscs) {
    expect_sound(std::string(motion) + R"([sedimentation]
interval_a = 5000.0
target = [
    {time_a = 0.0, points = [[0.0, 0.0]]},
    {time_a = 10000.0, points = [[1500.0, 0.0], [2000.0, -1600.0], [2500.0, -1600.0], [3000.0, 0.0]]},
]
)");
    const State state = read_snapshot(list_snapshots(folder / "run").back()).state;
    const ConstDiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        EXPECT_FALSE(d.x[i] > 2100.0 && d.x[i] < 2400.0 && d.y[i] > -1300.0) << d.y[i];
}

TEST_F(HeatAtItsEnds, SedimentAboveAll) {
    expect_sound(std::string(motion) +
                 "[sedimentation]\ninterval_a = 5000.0\nlevel_m = 400.0\n[compaction]\n");
}

TEST_F(HeatAtItsEnds, ABaseThatSinksFar) {
    expect_sound(std::string(staged) + R"([sedimentation]
interval_a = 5000.0
[compaction]
[base_motion]
uplift = [
    {time_a = 0.0, points = [[0.0, 0.0]]},
    {time_a = 10000.0, points = [[0.0, 0.0]]},
    {time_a = 20010000.0, points = [[0.0, -5000.0]]},
]
[[stage]]
distance_m = 100.0
[[stage]]
pause_a = 20e6
step_a = 1e6
settle_m = 50.0
)");
}

TEST_F(HeatAtItsEnds, APauseOfAHundredMillionYearsInOneStep) {
    const std::string pause = "[sedimentation]\n[compaction]\n[[stage]]\ndistance_m = 100.0\n"
                              "[[stage]]\npause_a = 100e6\nstep_a = ";
    expect_sound(staged + pause + "100e6\n");
    const auto once = load(rock + staged + pause + "100e6\n").warnings;
    ASSERT_EQ(once.size(), 1u);
    EXPECT_THAT(once[0], HasSubstr("stage[1].step_a"));
    EXPECT_TRUE(load(rock + staged + pause + "1e6\n").warnings.empty());
}

/// Heat goes back up; what has reacted stays so.
TEST_F(HeatAtItsEnds, ReflectanceKeepsItsMaximumOnTheWayBack) {
    const std::string text = std::string(staged) + R"([detachment]
footwall_top_m = 2000.0
[sedimentation]
interval_a = 5000.0
[[stage]]
distance_m = 300.0
[[stage]]
pause_a = 50e6
step_a = 10e6
settle_m = 50.0
[[stage]]
distance_m = -150.0
)";
    std::string whole = rock + text; // one table of the detachment
    const std::string title = "[detachment]\n", top = "footwall_top_m = 2000.0\n";
    whole.erase(whole.rfind(title), title.size() + top.size());
    whole.insert(whole.find(title) + title.size(), top);
    const Scene scene = load(whole);
    const auto reflectance = [&](std::optional<double> until, bool resume) {
        run(scene, "run", until, resume);
        const State state = read_snapshot(list_snapshots(folder / "run").back()).state;
        std::vector<std::pair<std::uint64_t, double>> by_id;
        const auto vitrinite = state.discs.get(thermal::columns::vitrinite);
        for (std::size_t i = 0; i < vitrinite.size(); ++i)
            by_id.emplace_back(disc_columns(state).id[i], vitrinite[i]);
        std::ranges::sort(by_id);
        return by_id;
    };
    const auto before = reflectance(550.0, false), after = reflectance({}, true);
    double most = 0.0;
    std::size_t k = 0;
    for (const auto& [id, value] : before) {
        most = std::max(most, value);
        while (k < after.size() && after[k].first < id)
            ++k;
        if (k < after.size() && after[k].first == id) {
            EXPECT_GE(after[k].second, value);
        }
    }
    EXPECT_GT(most, 0.22);
}

} // namespace
} // namespace listric::heat_test
