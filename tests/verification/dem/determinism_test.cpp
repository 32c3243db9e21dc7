// The state is all that the next cycle depends on: neither the cutting of a run into calls nor a
// copy of the state changes a bit. Exact comparisons.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

namespace listric::determinism_test {

using namespace dem;
namespace {

using namespace support;

class Determinism : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Determinism, every_cycle(), cycle_name);

constexpr CyclePhysics physics{0.7, 9.81};

/// A partly bonded cloud that falls into a box with a moving wall: contacts come and go.
struct Fall {
    RigidBase base = box(40.0 * 93.1, 1e5, 0.3);
    State state;

    Fall() {
        std::vector<Disc> discs = cloud(15, 15, 93.1, 4);
        for (Disc& disc : discs) {
            disc.x += 400.0;
            disc.y += 150.0;
        }
        state = make_state(discs);
        bond_all(state, base, 2e9f);
        state.clock.time_step = 0.008;
        base.surfaces[2].translation = {1.0, 0.0};
        base.surfaces[1].conveyor = 1.0;
        base.motion = {2.0, 4.0};
    }
};

TEST_P(Determinism, CallsMayBeCut) {
    Fall once, often;
    const std::uint64_t start = hash(once.state);
    advance(once.state, once.base, physics, 3000, GetParam());
    for (int k = 0; k < 30; ++k)
        advance(often.state, often.base, physics, 100, GetParam());
    EXPECT_EQ(hash(once.state), hash(often.state));
    for (std::int64_t cycles : {1, 7, 992})
        advance(often.state, often.base, physics, cycles, GetParam());
    advance(once.state, once.base, physics, 1000, GetParam());
    EXPECT_EQ(hash(once.state), hash(often.state));
    EXPECT_NE(hash(once.state), start);
    // Neighbours were searched anew on the way.
    EXPECT_NE(disc_columns(once.state).searched_y[200], disc_columns(once.state).start_y[200]);
}

TEST(Determinism, NeitherThreadsNorRegistersMatter) {
    Fall plain;
    advance(plain.state, plain.base, physics, 1500, {1, Cycle::plain});
    for (int threads : {1, 2, 5}) {
        Fall fast;
        advance(fast.state, fast.base, physics, 1500, {threads, fast_cycle()});
        EXPECT_EQ(hash(fast.state), hash(plain.state)) << threads << " threads";
    }
}

TEST(Determinism, WhatIsPackedMayBeKept) {
    for (int threads : {1, 2, 3, 5}) {
        Fall kept, anew;
        Packed packed;
        const Execution fast{threads, fast_cycle(), nullptr, &packed};
        const auto advance_both = [&](std::int64_t cycles) {
            advance(kept.state, kept.base, physics, cycles, fast);
            advance(anew.state, anew.base, physics, cycles, {1, Cycle::plain});
        };
        for (std::int64_t cycles : {1, 700, 800})
            advance_both(cycles);
        EXPECT_EQ(hash(kept.state), hash(anew.state)) << threads << " threads";
        const auto kick = [](State& state) {
            disc_columns(state).vx[7] += 1.0;
            contact_columns(state).bonded[3] = 0;
        };
        kick(kept.state);
        kick(anew.state);
        packed.forget();
        advance_both(800);
        EXPECT_EQ(hash(kept.state), hash(anew.state)) << threads << " threads";
        disc_columns(kept.state).vy[7] += 1.0;
        disc_columns(anew.state).vy[7] += 1.0;
        packed.forget_discs();
        advance_both(800);
        EXPECT_EQ(hash(kept.state), hash(anew.state)) << threads << " threads";
        // The plain cycle changes the state, too.
        advance(kept.state, kept.base, physics, 10, {1, Cycle::plain, nullptr, &packed});
        advance(anew.state, anew.base, physics, 10, {1, Cycle::plain});
        advance_both(100);
        EXPECT_EQ(hash(kept.state), hash(anew.state)) << threads << " threads";
        kick(kept.state); // and nobody is told
        kick(anew.state);
        advance_both(100);
        EXPECT_NE(hash(kept.state), hash(anew.state)) << "nothing was kept";
    }
}

TEST(Determinism, TeamsMayShrinkAndGrow) {
    Fall one, many;
    Packed packed;
    for (int k = 0; k < 20; ++k) {
        // Waiting long, and doing more by fewer, it shrinks.
        packed.team() = BestTeam(3);
        for (double speed = 1.0; packed.team().size() != 3 - k % 3; speed *= 2.0)
            packed.team().report(speed, 1.0, 3.0);
        advance(many.state, many.base, physics, 100, {3, fast_cycle(), nullptr, &packed});
    }
    advance(one.state, one.base, physics, 2000, {1, Cycle::plain});
    EXPECT_EQ(hash(many.state), hash(one.state));
}

TEST_P(Determinism, CopiesGoOnAlike) {
    Fall fall;
    advance(fall.state, fall.base, physics, 1234, GetParam());
    State copy = fall.state;
    ASSERT_EQ(hash(copy), hash(fall.state));
    advance(fall.state, fall.base, physics, 1500, GetParam());
    EXPECT_NE(hash(copy), hash(fall.state)); // columns are not shared
    advance(copy, fall.base, physics, 1500, GetParam());
    EXPECT_EQ(hash(copy), hash(fall.state));
}

TEST(Determinism, ClockCountsCyclesAndExtension) {
    Fall fall;
    advance(fall.state, fall.base, physics, 1000);
    EXPECT_EQ(fall.state.clock.cycle, 1000);
    // Speed 2 m/s after a ramp of 500 cycles, sampled at their beginnings: sum of 2 n / 500 dt.
    const double ramp = 2.0 * 0.008 * (0.5 * 499.0);
    EXPECT_NEAR(fall.state.clock.extension.m, ramp + 2.0 * 0.008 * 500.0, 1e-10);
}

} // namespace
} // namespace listric::determinism_test
