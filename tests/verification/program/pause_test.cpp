// A pause of the wall in a small halfgraben: the hanging wall comes to rest, sediment goes on, and
// when the wall moves on, strain is where it was.

#include "tests/scene_runs.hpp"

#include <cmath>
#include <map>
#include <numeric>
#include <span>

namespace listric::pause_test {

using namespace dem;
namespace {

using namespace support;

constexpr double begins = 300.0, ends = 900.0; // of the pause, m of travel
constexpr double interval = 60.0;              // of snapshots, m
constexpr double window = 180.0;               // in which strain is compared, m
constexpr double wall_speed = 1.0;             // m/s

const char* const scene_text = R"(
[extension]
speed_m_per_s = 1.0
ramp_s = 2.0
[output]
interval_m = 60.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
[fault_weakening]
[sedimentation]
interval_a = 6000.0
target = [
    {time_a = 0.0, points = [[0.0, 0.0]]},
    {time_a = 120000.0, points = [[0.0, 50.0]]},
]
[compaction]
[[stage]]
distance_m = 300.0
[[stage]]
pause_a = 60000.0
[[stage]]
distance_m = 300.0
)";

/// Mean speed of rock from before the rift, m/s.
double mean_speed(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0) {
            sum += std::hypot(d.vx[i], d.vy[i]);
            count += 1.0;
        }
    return sum / count;
}

/// By pre-rift disc, how far it moved between two moments against those that it touched at first,
/// m: root of the mean square.
std::vector<double> strain_between(const State& before, const State& after) {
    const ConstDiscColumns was = disc_columns(before), is = disc_columns(after);
    std::map<std::int64_t, std::size_t> row;
    for (std::size_t i = 0; i < is.id.size(); ++i)
        row[is.id[i]] = i;
    std::map<std::int64_t, std::pair<double, double>> sums; // squares, how many
    const ConstContactColumns c = contact_columns(before);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        if (was.stratum[i] != 0 || was.stratum[j] != 0)
            continue;
        const std::size_t m = row.at(was.id[i]), n = row.at(was.id[j]);
        const Point a{is.x[m] - was.x[i], is.y[m] - was.y[i]},
            b{is.x[n] - was.x[j], is.y[n] - was.y[j]};
        for (const std::int64_t id : {was.id[i], was.id[j]}) {
            sums[id].first += dot(a - b, a - b);
            sums[id].second += 1.0;
        }
    }
    std::vector<double> values;
    for (const auto& [id, sum] : sums)
        values.push_back(std::sqrt(sum.first / sum.second));
    return values;
}

int newest_stratum(const State& state) {
    return *std::ranges::max_element(disc_columns(state).stratum);
}

std::vector<double> ranks(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return values[k]; });
    std::vector<double> rank(values.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        rank[order[k]] = static_cast<double>(k);
    return rank;
}

/// Spearman's coefficient.
double rank_correlation(std::span<const double> a, std::span<const double> b) {
    const std::vector<double> x = ranks(a), y = ranks(b);
    const double mean = 0.5 * static_cast<double>(x.size() - 1);
    double xy = 0.0, xx = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        xy += (x[k] - mean) * (y[k] - mean);
        xx += (x[k] - mean) * (x[k] - mean);
    }
    return xy / xx;
}

using Pause = SceneRuns;

TEST_F(Pause, BringsRockToRestAndFaultsBackToLife) {
    const Scene scene = load(small_halfgraben() + scene_text);
    const auto summary = run(scene, "pause");
    const RunFolder folder(options("pause").output);
    const auto at = [&](double travel) {
        return folder.read(folder.snapshots_at({travel}).front()).state;
    };
    const State moves = at(begins - interval), rests = at(begins), still = at(ends),
                before = at(begins - window), after = at(ends + window);
    EXPECT_NEAR(still.clock.extension.m, begins, 0.1);
    EXPECT_NEAR(after.clock.extension.m, begins + window, 0.1);

    // With the wall's speed the mean speed falls to less than a hundredth of it within a tenth of
    // the pause, and stays there: found 0.0013 and less.
    EXPECT_GT(mean_speed(moves), 0.5 * wall_speed);
    for (const double share : {0.1, 0.2, 0.5, 0.8, 1.0})
        EXPECT_LT(mean_speed(at(std::lerp(begins, ends, share))), 0.01 * wall_speed) << share;

    // Ten intervals of sedimentation; a stratum that finds no room has no discs: six do.
    EXPECT_GE(newest_stratum(still) - newest_stratum(rests), 5);
    EXPECT_GT(still.discs.rows(), rests.discs.rows());
    EXPECT_LT(summary["mass_error_fraction"].get<double>(), 1e-12);

    // Found 0.93; from one such way to the next without a pause 0.94.
    EXPECT_GT(rank_correlation(strain_between(before, rests), strain_between(still, after)), 0.9);
}

} // namespace
} // namespace listric::pause_test
