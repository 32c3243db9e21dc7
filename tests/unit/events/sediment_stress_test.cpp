// Loads and means of the sediment's layers in a lattice of discs that do not touch: what holds
// them up, if anything, is damping, alpha of the weight of what falls. Sums of a few hundred terms:
// 1e-12.

#include "dem/events/sediment_stress.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::sediment_stress_test {

using namespace dem;
namespace {

using namespace support;

constexpr CyclePhysics physics{0.7, 9.81};
constexpr double rate = 0.01;

/// Sediment 3.6 km thick from x = 2 to 6 km, falling.
State lattice() {
    std::vector<Disc> discs;
    for (double x = 2e3; x < 6e3; x += 50.0)
        for (double y = -25.0; y > -3.6e3; y -= 50.0)
            discs.push_back({x, y, 24.0});
    State state = make_state(discs);
    const DiscColumns d = disc_columns(state);
    std::ranges::fill(d.stratum, 1);
    std::ranges::fill(d.vy, -1.0);
    return state;
}

TEST(SedimentStress, LayersWeighWhatIsAbove) {
    const State state = lattice();
    const std::vector<LayerLoad> loads = layer_loads(state, {}, physics);
    ASSERT_EQ(loads.size(), 7u);
    const double disc = density * pi * 24.0 * 24.0 * 9.81;
    for (std::size_t k = 0; k < loads.size(); ++k) {
        EXPECT_EQ(loads[k].is_sediment, k < 3) << k;
        // Rows 50 m apart, 50 discs in each; the surface is the highest discs' top, 1 m down.
        const double rows = std::min(20.0 * static_cast<double>(k + 1), 72.0);
        if (loads[k].is_sediment) {
            EXPECT_NEAR(loads[k].weight / disc, 50.0 * rows, 2.0 * 50.0) << k;
        }
        EXPECT_NEAR(loads[k].damping, 0.7 * loads[k].weight, 1e-12 * loads[k].weight);
        EXPECT_EQ(loads[k].contacts, 0.0);
    }
}

TEST(SedimentStress, DampingIsAgainstTheMeanMotionWhereTheCycleIs) {
    State state = lattice();
    add_mean_velocities(state);
    std::ranges::fill(state.discs.get<float>("mean_vy"), -2.0f); // they rise from their mean
    const CyclePhysics relative{0.7, 9.81, 150.0};
    const LayerLoad load = layer_loads(state, {}, relative).front();
    EXPECT_NEAR(load.damping, -0.7 * load.weight, 1e-12 * load.weight);
}

TEST(SedimentStress, DampingIsAgainstTheThinningOfAStretchingBase) {
    const State state = lattice(); // it sinks more slowly than it would thin
    RigidBase base;
    base.surfaces = {{"floor", {line({0.0, -10e3}, {10e3, -10e3})}, 0.5}};
    base.surfaces[0].stretched_length = 1e3;
    base.motion.speed = 1.0;
    const LayerLoad load = layer_loads(state, base, physics).front();
    EXPECT_NEAR(load.damping, -0.7 * load.weight, 1e-12 * load.weight);
}

TEST(SedimentStress, BasementAndVoidAreNotMeasured) {
    State state = lattice();
    std::ranges::fill(disc_columns(state).stratum, 0);
    for (const LayerLoad& load : layer_loads(state, {}, physics))
        EXPECT_FALSE(load.is_sediment);
    for (const LayerLoad& load : layer_loads(make_state({{0.0, 0.0, 90.0}}), {}, physics))
        EXPECT_FALSE(load.is_sediment);
    SedimentStress event(500.0, 5.0, rate, physics);
    event.apply(state, {});
    EXPECT_TRUE(event.profile().empty());
}

TEST(SedimentStress, SamplesCoverTheIntervalAndWhatFollowsACompaction) {
    for (const double interval : {5.0, 25.0, 7.0, 100.0}) {
        SedimentStress event(500.0, interval, rate, physics);
        double last = -1.0;
        std::vector<int> phases(8, 0), after(8, 0);
        for (; event.next_due().m < 50.0 * 500.0; ++event.applied) {
            const double due = event.next_due().m;
            EXPECT_GT(due, last);
            last = due;
            const double since = std::fmod(due, interval);
            if (event.applied % 2 == 0) {
                ASSERT_LT(since, 0.5);
                ++after[static_cast<std::size_t>(since / 0.5 * 8.0)];
            } else {
                ++phases[static_cast<std::size_t>(since / interval * 8.0)];
            }
        }
        const double expected = interval > 500.0 / 16.0 ? 500.0 / interval : 16.0;
        for (const std::vector<int>& counts : {phases, after}) {
            const auto [least, most] = std::ranges::minmax(counts);
            EXPECT_LE(most - least, 1) << interval;
            EXPECT_NEAR(8.0 * least / 50.0, expected, 0.3 * expected) << interval;
        }
    }
    SedimentStress steady(500.0, std::nullopt, rate, physics);
    steady.applied = 16;
    EXPECT_NEAR(steady.next_due().m, 500.0 + 500.0 / 16.0 / 16.0, 1e-9);
}

TEST(SedimentStress, MeansAreOfTheLastWindow) {
    State state = lattice();
    SedimentStress event(500.0, 5.0, rate, physics);
    const auto sample = [&](double extension, double vy) {
        state.clock.travel.m = state.clock.extension.m = extension;
        std::ranges::fill(disc_columns(state).vy, vy);
        EXPECT_FALSE(event.apply(state, {}));
        ++event.applied;
    };
    sample(400.0, -1.0); // after a compaction
    sample(410.0, -1.0);
    ASSERT_EQ(event.profile().size(), 3u);
    EXPECT_NEAR(event.profile()[0].damping_share, 0.7, 1e-12);
    EXPECT_EQ(event.profile()[0].ratio, 0.0);
    EXPECT_EQ(event.profile()[1].depth, 2000.0);

    sample(500.1, -1.0); // the next window
    EXPECT_TRUE(event.profile().empty());
    sample(600.0, -1.0);
    sample(650.0, 1.0); // after a compaction: of no account for the mean
    sample(651.0, 1.0);
    sample(700.0, 1.0);
    sample(900.0, 0.0); // at rest nothing is damped
    EXPECT_NEAR(event.profile()[2].damping_share, 0.0, 1e-12);
    EXPECT_EQ(event.profile()[2].after_event_ratio.value(), 0.0);

    SedimentStress steady(500.0, std::nullopt, rate, physics);
    steady.apply(state, {});
    EXPECT_FALSE(steady.profile().front().after_event_ratio);
}

} // namespace
} // namespace listric::sediment_stress_test
