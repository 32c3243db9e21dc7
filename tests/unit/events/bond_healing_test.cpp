// A touching pair heals if its slip since the last healing is below strain rate * interval *
// diameter; the slip is the turning of the line of centres less the rolling of both discs, so a
// pair that turns as one body heals. Thresholds are approached to one percent, which is coarse
// against the second-order error of a finite turn (1.5 cm in 186 m).

#include "dem/events/bond_healing.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::bond_healing_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1, rate = 0.01;
const double allowed = 1e-15 * 2.5e3 * seconds_per_year * 2.0 * r; ///< slip, m

/// Two discs, overlapping by a metre unless said otherwise, since begin.
struct Pair {
    State state;
    BondHealing event;

    explicit Pair(double overlap = 1.0, BondHealingParameters parameters = {})
        : state(make_state({{0.0, 0.0, r}, {2.0 * r - overlap, 0.0, r}})),
          event(parameters, {}, rate) {
        event.begin(state);
        state.clock.travel.m = state.clock.extension.m = event.schedule().spacing();
    }
    bool heals() {
        find_contacts(state, {});
        event.apply(state, {});
        return contact_columns(state).bonded[0] == 1;
    }
    DiscColumns discs() { return disc_columns(state); }
};

TEST(BondHealing, PairAtRestHeals) {
    Pair p;
    ASSERT_TRUE(p.heals());
    // Stresses on the section, 2e4 +- 0.5e4 Pa and 2e8 +- 0.5e8 Pa; five deviations.
    const ContactColumns c = contact_columns(p.state);
    EXPECT_NEAR(c.tensile_strength[0] / (2.0 * r), 2.0e4, 2.5e4);
    EXPECT_NEAR(c.shear_strength[0] / (2.0 * r), 2.0e8, 2.5e8);
    EXPECT_GT(c.shear_strength[0], 0.0f);
}

TEST(BondHealing, RigidlyRotatingPairHeals) {
    for (double turn : {-0.5, 0.033, 1.2}) {
        Pair p;
        const DiscColumns d = p.discs();
        const double distance = d.x[1];
        d.x[1] = distance * std::cos(turn) + 700.0;
        d.y[1] = distance * std::sin(turn) - 300.0;
        d.x[0] = 700.0;
        d.y[0] = -300.0;
        d.rotation[0] = d.rotation[1] = turn;
        EXPECT_TRUE(p.heals()) << turn;
    }
}

TEST(BondHealing, SlippingPairDoesNot) {
    for (double sign : {-1.0, 1.0}) {
        Pair little, much;
        little.discs().y[1] = sign * 0.99 * allowed;
        much.discs().y[1] = sign * 1.01 * allowed;
        EXPECT_TRUE(little.heals());
        EXPECT_FALSE(much.heals());
    }
}

TEST(BondHealing, SpinningAgainstEachOtherIsSlip) {
    Pair little, much, rolling;
    const double arm = r - 0.5;
    little.discs().rotation[0] = 0.99 * allowed / arm;
    much.discs().rotation[0] = 1.01 * allowed / arm;
    rolling.discs().rotation[0] = 0.1; // two gears
    rolling.discs().rotation[1] = -0.1;
    EXPECT_TRUE(little.heals());
    EXPECT_FALSE(much.heals());
    EXPECT_TRUE(rolling.heals());
}

TEST(BondHealing, SlipCountsFromTheLastHealing) {
    Pair p;
    p.discs().y[1] = 5.0 * allowed;
    EXPECT_FALSE(p.heals());
    p.state.clock.travel.m = p.state.clock.extension.m += p.event.schedule().spacing();
    EXPECT_TRUE(p.heals()); // it has not moved since
}

TEST(BondHealing, OpeningCountsOnRequest) {
    Pair slip, both(1.0, {.measure = HealingMeasure::slip_and_opening});
    slip.discs().x[1] += 2.0 * allowed;
    both.discs().x[1] += 2.0 * allowed;
    EXPECT_TRUE(slip.heals());
    EXPECT_FALSE(both.heals());
}

TEST(BondHealing, OnlyTouchingPairsHeal) {
    Pair apart(-1.0), touching(1e-6);
    EXPECT_FALSE(apart.heals());
    EXPECT_TRUE(touching.heals());
}

TEST(BondHealing, WeakDiscsNeverHeal) {
    for (std::size_t i : {0, 1}) {
        Pair p;
        p.discs().material[i] = weak;
        EXPECT_FALSE(p.heals());
    }
}

TEST(BondHealing, DiscsWithoutAHistoryWait) {
    Pair p;
    p.discs().start_travel[1] = 0.5 * p.state.clock.extension.m;
    EXPECT_FALSE(p.heals());
    p.state.clock.travel.m = p.state.clock.extension.m += p.event.schedule().spacing();
    EXPECT_TRUE(p.heals());
}

TEST(BondHealing, DiscsLaidDownAtTheLastHealingAreJudgedAsAllOthers) {
    for (const double late : {-0.01, 0.0, 0.01}) { // events come half a cycle early or late
        Pair still, slips;
        still.discs().start_travel[1] = slips.discs().start_travel[1] = late;
        slips.discs().y[1] = 1.01 * allowed;
        EXPECT_TRUE(still.heals()) << late;
        EXPECT_FALSE(slips.heals()) << late;
    }
}

TEST(BondHealing, StandingBondsKeepTheirStrength) {
    Pair p;
    find_contacts(p.state, {});
    bond(p.state, 0, 1.0f, 2.0f);
    ASSERT_TRUE(p.heals());
    EXPECT_EQ(contact_columns(p.state).tensile_strength[0], 1.0f);
}

} // namespace
} // namespace listric::bond_healing_test
