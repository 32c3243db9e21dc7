// Sedimentation fills up to the target with discs that touch without overlap, removes what lies
// above it, books both masses, and leaves what is full alone. Ground places discs to 1e-4 m; the
// fill's bulk density is that of the grains at surface porosity, to ten percent since a tenth of
// the discs touches a wall or the surface, where packing is looser.

#include "dem/cycle/cycle.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/events/bond_healing.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/sedimentation.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace listric::sedimentation_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1, width = 40.0 * r, depth = 30.0 * r;
constexpr double rate = 0.01; // m/a

struct Basin {
    RigidBase base = box(width, 1e5);
    State state = make_state(row(20, r));
    Sedimentation event;

    explicit Basin(double level = depth) : event({.level = level}, 1.66, rate) {
        for (double& x : disc_columns(state).x)
            x += r;
        for (double& y : disc_columns(state).y)
            y += r;
        state.clock.travel.m = state.clock.extension.m = 3.0 * event.schedule().spacing();
    }
};

TEST(Sedimentation, WhatOthersRememberOfNewDiscsBeginsAtTheirPlaces) {
    Basin b;
    BondHealing({}, {}, rate).begin(b.state);
    FaultWeakening({}, rate, 9.81).begin(b.state);
    for (double& y : disc_columns(b.state).y)
        y += 1.0; // after it was remembered
    ASSERT_TRUE(b.event.apply(b.state, b.base));
    const DiscColumns d = disc_columns(b.state);
    for (const char* remembered : {"healed_y", "scanned_y"}) {
        const auto y = b.state.discs.get<double>(remembered);
        for (std::size_t i = 0; i < y.size(); ++i)
            EXPECT_EQ(d.y[i] - y[i], d.stratum[i] == 0 ? 1.0 : 0.0) << remembered;
    }
    EXPECT_GT(std::ranges::count_if(d.stratum, [](std::int32_t s) { return s > 0; }), 100);
}

TEST(Sedimentation, AFillTellsHowFarItIsAndCanBeEnded) {
    Basin b, other;
    std::vector<std::string> told;
    b.event.step_report = [&](const std::string& done) { told.push_back(done); };
    ASSERT_TRUE(b.event.apply(b.state, b.base));
    ASSERT_GT(told.size(), 10u);
    EXPECT_EQ(told.front(), "sedimentation: 0 discs laid down");
    EXPECT_NE(told.back(), told.front());
    ASSERT_TRUE(other.event.apply(other.state, other.base));
    EXPECT_EQ(hash(b.state), hash(other.state)); // who listens changes nothing

    struct Enough {};
    Basin ended;
    int calls = 0;
    ended.event.step_report = [&](const std::string&) {
        if (++calls == 3)
            throw Enough();
    };
    EXPECT_THROW(ended.event.apply(ended.state, ended.base), Enough);
    EXPECT_EQ(calls, 3);
}

TEST(Sedimentation, ALineBelowAllDiscsIsNoMatterOfTheTimeStep) {
    Basin b(-1e4);
    EXPECT_THROW(b.event.apply(b.state, b.base), NothingLeft);
}

TEST(Sedimentation, FillsToTheLevelWithoutOverlap) {
    Basin b;
    ASSERT_TRUE(b.event.apply(b.state, b.base));
    const DiscColumns d = disc_columns(b.state);
    const double smallest = 2.0 * r / 2.66, largest = 1.66 * smallest;
    std::vector<double> top(20, 0.0);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        int held_by = d.y[i] < d.radius[i] + 1e-3;
        for (std::size_t j = 0; j < d.x.size(); ++j) {
            if (j == i)
                continue;
            const double gap =
                std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i]) - d.radius[i] - d.radius[j];
            EXPECT_GE(gap, -1e-6 * r);
            held_by += gap < 1e-5 * r && d.y[j] < d.y[i];
        }
        EXPECT_GE(d.x[i], d.radius[i] - 1e-6 * r);
        EXPECT_LE(d.x[i], width - d.radius[i] + 1e-6 * r);
        if (d.stratum[i] == 0)
            continue;
        EXPECT_GE(held_by, 1);
        EXPECT_GE(d.radius[i], smallest);
        EXPECT_LE(d.radius[i], largest);
        EXPECT_LE(d.y[i] + d.radius[i], depth + 0.5 * smallest);
        auto& t = top[static_cast<std::size_t>(std::clamp(20.0 * d.x[i] / width, 0.0, 19.0))];
        t = std::max(t, d.y[i] + d.radius[i]);
    }
    for (double t : top)
        EXPECT_GT(t, depth - 2.0 * largest);
}

TEST(Sedimentation, RecordsTheNewDiscs) {
    Basin b;
    b.event.apply(b.state, b.base);
    const DiscColumns d = disc_columns(b.state);
    double deposited = 0.0;
    std::vector<std::int64_t> ids(d.id.begin(), d.id.end());
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        EXPECT_EQ(d.material[i], d.id[i] < 20 ? basement : sediment);
        EXPECT_EQ(d.stratum[i], d.id[i] < 20 ? 0 : 3);
        if (d.id[i] < 20)
            continue;
        EXPECT_EQ(d.start_x[i], d.x[i]);
        EXPECT_EQ(d.start_y[i], d.y[i]);
        EXPECT_EQ(d.start_travel[i], b.state.clock.extension.m);
        EXPECT_EQ(d.vx[i], 0.0);
        deposited += d.mass[i];
    }
    std::ranges::sort(ids);
    EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
    EXPECT_NEAR(b.state.ledger.deposited, deposited, 1e-12 * deposited);
    const double bulk = 2600.0 * 0.5 * width * (depth - 2.0 * r);
    EXPECT_NEAR(deposited, bulk, 0.1 * bulk);
}

TEST(Sedimentation, LeavesWhatIsFullAlone) {
    Basin b(r); // below the tops of the discs that are there
    const std::uint64_t before = hash(b.state);
    EXPECT_FALSE(b.event.apply(b.state, b.base));
    EXPECT_EQ(hash(b.state), before);
}

TEST(Sedimentation, SecondHelpingIsSmall) {
    Basin b;
    b.event.apply(b.state, b.base);
    const std::size_t filled = b.state.discs.rows();
    b.state.clock.travel.m = b.state.clock.extension.m += b.event.schedule().spacing();
    b.event.apply(b.state, b.base);
    EXPECT_LT(b.state.discs.rows() - filled, filled / 50);
}

TEST(Sedimentation, DependsOnTheSeedAlone) {
    Basin a, same, other;
    other.state.seed = 2;
    for (Basin* b : {&a, &same, &other})
        b->event.apply(b->state, b->base);
    EXPECT_EQ(hash(a.state), hash(same.state));
    other.state.seed = a.state.seed;
    EXPECT_NE(hash(a.state), hash(other.state));
}

/// Height of the surface, m, in columns one mean diameter wide.
std::vector<double> surface(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> top(20, 0.0);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        auto& t = top[static_cast<std::size_t>(std::clamp(20.0 * d.x[i] / width, 0.0, 19.0))];
        t = std::max(t, d.y[i] + d.radius[i]);
    }
    return top;
}

double mass_of(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    return std::accumulate(d.mass.begin(), d.mass.end(), 0.0);
}

TEST(Sedimentation, ErosionRemovesWhatLiesAboveAndAccountsForIt) {
    Basin b;
    b.event.apply(b.state, b.base);
    bond_all(b.state, b.base);
    const std::vector<std::int32_t> strata(disc_columns(b.state).stratum.begin(),
                                           disc_columns(b.state).stratum.end());
    const double before = mass_of(b.state);
    const std::size_t contacts = b.state.contacts.rows();
    constexpr double level = 0.5 * depth;
    std::set<std::int64_t> above;
    double above_mass = 0.0;
    {
        const DiscColumns d = disc_columns(b.state);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.y[i] - d.radius[i] > level) {
                above.insert(d.id[i]);
                above_mass += d.mass[i];
            }
    }
    ASSERT_GT(above.size(), 50u);
    Ledger& ledger = b.state.ledger;
    const double deposited = ledger.deposited;
    Sedimentation lower({.level = level}, 1.66, rate);
    b.state.clock.travel.m = b.state.clock.extension.m += lower.schedule().spacing();
    ASSERT_TRUE(lower.apply(b.state, b.base));

    const DiscColumns d = disc_columns(b.state);
    std::set<std::int64_t> left;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        EXPECT_LE(d.y[i] - d.radius[i], level);
        EXPECT_FALSE(above.contains(d.id[i]));
        left.insert(d.id[i]);
        if (d.id[i] >= 20 && d.stratum[i] != 4) {
            EXPECT_EQ(d.stratum[i], 3); // of what remains, not of this sedimentation
        }
    }
    for (std::size_t id = 0; id < strata.size(); ++id)
        EXPECT_EQ(left.contains(static_cast<std::int64_t>(id)),
                  !above.contains(static_cast<std::int64_t>(id)));
    // The bonds went with the discs, the others stayed.
    const ContactColumns c = contact_columns(b.state);
    EXPECT_GT(c.first.size(), 0u);
    EXPECT_LT(c.first.size(), contacts);
    EXPECT_TRUE(std::ranges::count(c.bonded, 1) > 100);
    EXPECT_NEAR(ledger.removed, above_mass, 1e-12 * before);
    EXPECT_NEAR(mass_of(b.state), ledger.initial + ledger.deposited - ledger.removed,
                1e-12 * before);
    EXPECT_LT(ledger.deposited - deposited, 0.02 * before);
    // Cutting and filling leave the surface within a disc diameter of the line.
    const double diameter = 2.0 * 2.0 * r / 2.66 * 1.66;
    for (double top : surface(b.state))
        EXPECT_NEAR(top, level, diameter);
}

TEST(Sedimentation, TheSurfaceFollowsAPolyline) {
    // A valley and a hill with slopes of up to 20 degrees: looser piles would roll down.
    Basin b(0.5 * depth);
    b.event.apply(b.state, b.base);
    const std::vector<Point> points{{0.0, 0.5 * depth},
                                    {0.3 * width, 0.5 * depth - 0.1 * width},
                                    {0.7 * width, 0.5 * depth + 0.04 * width},
                                    {width, 0.5 * depth + 0.1 * width}};
    Sedimentation shaped({.target = {{0.0, points}}}, 1.66, rate);
    b.state.clock.travel.m = b.state.clock.extension.m += shaped.schedule().spacing();
    ASSERT_TRUE(shaped.apply(b.state, b.base));
    EXPECT_GT(b.state.ledger.removed, 0.0);
    EXPECT_NEAR(mass_of(b.state),
                b.state.ledger.initial + b.state.ledger.deposited - b.state.ledger.removed,
                1e-12 * b.state.ledger.deposited);
    const TargetLine line(points);
    const double diameter = 2.0 * 2.0 * r / 2.66 * 1.66;
    const std::vector<double> top = surface(b.state);
    for (std::size_t k = 0; k < top.size(); ++k)
        EXPECT_NEAR(top[k], line.height((static_cast<double>(k) + 0.5) * width / 20.0), diameter)
            << k;
}

TEST(Sedimentation, ATargetThatFallsWithTime) {
    // 3 intervals of 50,000 a have passed: the line stands at 0.7 depth, and later at 0.4.
    Basin b;
    Sedimentation falling({.target = {{0.0, {{0.0, depth}}}, {500e3, {{0.0, 0.0}}}}}, 1.66, rate);
    falling.apply(b.state, b.base);
    const double diameter = 2.0 * 2.0 * r / 2.66 * 1.66;
    for (double top : surface(b.state))
        EXPECT_NEAR(top, 0.7 * depth, diameter);
    b.state.clock.travel.m = b.state.clock.extension.m = 6.0 * falling.schedule().spacing();
    falling.apply(b.state, b.base);
    for (double top : surface(b.state))
        EXPECT_NEAR(top, 0.4 * depth, diameter);
}

TEST(Sedimentation, ATargetBelowEverythingIsRefused) {
    Basin b(-1e4);
    EXPECT_THROW(b.event.apply(b.state, b.base), NumericalFailure);
}

} // namespace
} // namespace listric::sedimentation_test
