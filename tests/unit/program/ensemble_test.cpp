// Runs of several seeds side by side: chances of a fault, spread of tops.

#include "apps/studies/ensemble/ensemble.hpp"
#include "dem/numbers/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace listric {
namespace {

EnsembleRun run_with(std::vector<double> upper_ends, std::vector<double> top) {
    EnsembleRun run;
    for (const double x : upper_ends)
        run.faults.push_back({{{x, 0.0}, {x + 500.0, -4000.0}}, true});
    run.tops[0] = std::move(top);
    return run;
}

TEST(EnsembleOfSeeds, CountsSeedsWithAFaultByKilometre) {
    Ensemble ensemble{
        .title = "x", .length = 3000.0, .depth = 1.0, .base = {}, .scene = {}, .runs = {}};
    ensemble.runs = {run_with({200.0, 700.0}, {}), run_with({900.0, 2500.0}, {}), run_with({}, {})};
    const std::vector<FaultChance> chances = fault_chances(ensemble);
    ASSERT_EQ(chances.size(), 3u);
    EXPECT_EQ(chances[0].met, 2) << "two faults of a seed count once";
    EXPECT_EQ(chances[1].met, 0);
    EXPECT_EQ(chances[2].met, 1);
    EXPECT_EQ(chances[2].of, 3);
    EXPECT_GT(chances[2].limits.upper, 1.0 / 3.0);
}

TEST(EnsembleOfSeeds, TopsAreMeansWhereHalfOfTheSeedsHaveThem) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Ensemble ensemble{
        .title = "x", .length = 500.0, .depth = 1.0, .base = {}, .scene = {}, .runs = {}};
    ensemble.runs = {run_with({}, {1.0, 2.0, none}), run_with({}, {3.0, none, none}),
                     run_with({}, {5.0, 4.0, 7.0})};
    const std::vector<TopSpread> tops = top_spreads(ensemble);
    ASSERT_EQ(tops.size(), 1u);
    EXPECT_EQ(tops[0].x, (std::vector<double>{0.0, 250.0}));
    EXPECT_EQ(tops[0].mean, (std::vector<double>{3.0, 3.0}));
    EXPECT_DOUBLE_EQ(tops[0].deviation[0], 2.0);
}

// The bars of the picture: of made sets with a known chance, 90 to 96 of 100 bars hold it (the
// exact interval of Clopper and Pearson covers at least what it says, here 90 %, with twenty seeds
// some more, since counts are whole).
TEST(EnsembleOfSeeds, BarsHoldTheTruthAsOftenAsTheySay) {
    constexpr int sets = 4000, seeds = 20;
    std::vector<ProbabilityLimits> limits; // by how many seeds have a fault
    for (int met = 0; met <= seeds; ++met)
        limits.push_back(probability_limits(met, seeds));
    int held = 0;
    for (std::uint64_t set = 0; set < sets; ++set) {
        const auto drawn = [&](std::uint64_t k) {
            return dem::uniform(7, dem::Purpose::sweep_order, set, k);
        };
        const double chance = 0.1 + 0.8 * drawn(0);
        std::size_t met = 0;
        for (std::uint64_t k = 1; k <= seeds; ++k)
            met += drawn(k) < chance ? 1 : 0;
        held += limits[met].lower <= chance && chance <= limits[met].upper ? 1 : 0;
    }
    EXPECT_GE(held, 0.90 * sets);
    EXPECT_LE(held, 0.96 * sets);
}

} // namespace
} // namespace listric
