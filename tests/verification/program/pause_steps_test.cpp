// A pause of 60 Ma on a base that sinks by half a kilometre: strata lie where they do by 60 steps,
// by 240, and where the steps take half as much travel.

#include "tests/scene_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace listric::pause_steps_test {

using namespace dem;
namespace {

using namespace support;

constexpr double breaks = 200.0, years = 60e6;  // way of the wall before, m; the pause, a
constexpr double left = 1000.0, right = 3500.0; // where tops are compared, m
constexpr int columns = 10;

const char* const scene_text = R"(
[extension]
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 1000.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
[sedimentation]
interval_a = 5000.0
[compaction]
[base_motion]
uplift = [
    {time_a = 0.0, points = [[0.0, 0.0], [1500.0, 0.0]]},
    {time_a = 20000.0, points = [[0.0, 0.0], [1500.0, 0.0]]},
    {time_a = 60020000.0, points = [[0.0, 0.0], [1500.0, -500.0]]},
]
)";

/// Height of the highest discs of what was laid down up to an age, by column, m.
std::vector<double> top(const Scene& scene, const State& state, double age) {
    const ConstDiscColumns d = disc_columns(state);
    const Calendar calendar = make_calendar(scene);
    std::vector<double> height(columns, -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double column = (d.x[i] - left) / (right - left) * columns;
        if (column >= 0.0 && column < columns &&
            calendar.age(Travel(d.start_travel[i])) <= age * (1.0 + 1e-6)) {
            double& here = height[static_cast<std::size_t>(column)];
            here = std::max(here, d.y[i] + d.radius[i]);
        }
    }
    return height;
}

class PauseSteps : public SceneRuns {
protected:
    struct End {
        Scene scene;
        State state;
    };

    End end_of(int steps, double settle) const {
        const Scene scene =
            load(small_halfgraben() + scene_text +
                 fmt::format("[[stage]]\ndistance_m = {}\n[[stage]]\npause_a = {}\nstep_a = {}\n"
                             "settle_m = {}\n",
                             breaks, years, years / steps, settle));
        const std::string name = fmt::format("{}-{}", steps, settle);
        EXPECT_EQ(run(scene, name)["steps"], steps);
        return {scene, read_snapshot(list_snapshots(folder / name).back()).state};
    }
};

TEST_F(PauseSteps, StrataLieWhereTheyDoByFourTimesAsMany) {
    const End usual = end_of(60, 100.0);
    const double half_a_disc = usual.state.mean_radius;
    for (const auto& [steps, settle] : {std::pair(240, 100.0), std::pair(60, 200.0)}) {
        const End other = end_of(steps, settle);
        for (const double share : {0.25, 0.5, 0.75, 1.0}) {
            const double age = 20e3 + share * years;
            const std::vector<double> a = top(usual.scene, usual.state, age),
                                      b = top(other.scene, other.state, age);
            double mean = 0.0;
            for (int k = 0; k < columns; ++k)
                mean += (b[static_cast<std::size_t>(k)] - a[static_cast<std::size_t>(k)]) / columns;
            EXPECT_LT(std::abs(mean), half_a_disc) << steps << " " << settle << " " << share;
        }
    }
}

} // namespace
} // namespace listric::pause_steps_test
