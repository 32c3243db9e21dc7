// The fast cycle computes the same bits as the plain one, which is its specification, with any
// number of threads. Exact comparisons, over contacts that form, slip and break, over neighbour
// searches, and with a base that moves.

#include "dem/base/rest.hpp"
#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::fast_cycle_test {

using namespace dem;
namespace {

using namespace support;

/// A disturbed lattice, partly bonded, partly of soft frictionless discs, dropped on a conveyor.
struct Heap {
    RigidBase base = box(62.0 * 93.1, 1e5, 0.4);
    State state;

    explicit Heap(std::size_t rows, float strength, double friction = 0.3) {
        std::vector<Disc> discs = cloud(28, rows, 93.1, 7);
        for (Disc& disc : discs) {
            disc.x += 300.0;
            disc.y += 150.0;
        }
        state = make_state(discs, Material{1.7e11, 6.38e10, friction, true});
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < d.x.size(); i += 7) {
            d.material[i] = weak;
            d.vx[i] = 3.0;
        }
        sort_discs(state);
        bond_all(state, base, strength);
        state.clock.time_step = 0.006;
        base.surfaces[1].conveyor = 1.0;
        base.surfaces[2].translation = {1.0, 0.0};
        base.motion = {1.5, 3.0};
    }
};

std::int64_t bonds(const State& state) {
    return std::ranges::count(contact_columns(state).bonded, std::uint8_t{1});
}

constexpr CyclePhysics physics{0.7, 9.81};

TEST(FastCycle, HasTheBitsOfThePlainOne) {
    // 1 disc row: less than a tile; 45 rows: ten tiles.
    for (std::size_t rows : {1, 3, 45})
        for (float strength : {0.0f, 3e9f, 1e30f}) {
            Heap heap(rows, strength);
            State plain = heap.state;
            const std::int64_t bonds_before = bonds(plain);
            advance(plain, heap.base, physics, 1500, {1, Cycle::plain});
            for (int threads : {1, 2, 3, 5}) {
                State fast = heap.state;
                advance(fast, heap.base, physics, 1500, {threads, fast_cycle()});
                EXPECT_EQ(hash(fast), hash(plain))
                    << rows << " rows, strength " << strength << ", threads " << threads;
            }
            if (rows == 45 && strength == 3e9f) {
                EXPECT_LT(bonds(plain), bonds_before);
                EXPECT_GT(bonds(plain), 0);
            }
            EXPECT_NE(hash(plain), hash(heap.state));
        }
}

TEST(FastCycle, OnAStretchingBase) {
    Heap heap(20, 3e9f);
    heap.base.surfaces[1].conveyor = 0.0;
    heap.base.surfaces[1].stretched_length = 62.0 * 93.1;
    State plain = heap.state, fast = heap.state, unstretched = heap.state;
    advance(plain, heap.base, physics, 1500, {1, Cycle::plain});
    advance(fast, heap.base, physics, 1500, {2, fast_cycle()});
    EXPECT_EQ(hash(fast), hash(plain));
    heap.base.surfaces[1].stretched_length = 0.0;
    advance(unstretched, heap.base, physics, 1500, {1, Cycle::plain});
    EXPECT_NE(hash(unstretched), hash(plain));
}

TEST(FastCycle, OnABaseThatShortens) {
    Heap heap(20, 3e9f);
    heap.base.surfaces[1].conveyor = 0.0;
    heap.base.surfaces[1].stretched_length = 62.0 * 93.1;
    heap.base.motion.speed *= -1.0;
    State plain = heap.state, fast = heap.state;
    advance(plain, heap.base, physics, 1500, {1, Cycle::plain});
    advance(fast, heap.base, physics, 1500, {2, fast_cycle()});
    EXPECT_EQ(hash(fast), hash(plain));
}

TEST(FastCycle, WithoutBondsAndWithoutFriction) {
    for (float strength : {-1.0f, 3e9f})
        for (double friction : {0.0, 0.3}) {
            Heap heap(20, strength, friction);
            if (strength < 0.0f)
                std::ranges::fill(contact_columns(heap.state).bonded, std::uint8_t{0});
            State plain = heap.state, fast = heap.state;
            advance(plain, heap.base, physics, 1500, {1, Cycle::plain});
            advance(fast, heap.base, physics, 1500, {2, fast_cycle()});
            EXPECT_EQ(hash(fast), hash(plain))
                << "strength " << strength << ", friction " << friction;
        }
}

/// Every loop that is compiled, at every level of this processor.
TEST(FastCycle, HasTheSameBitsAtEveryLevel) {
    for (const bool stretches : {false, true})
        for (const double averaging_time : {0.0, 2.0})
            for (const float strength : {-1.0f, 3e9f})
                for (const double friction : {0.0, 0.3}) {
                    Heap heap(20, strength, friction);
                    if (strength < 0.0f)
                        std::ranges::fill(contact_columns(heap.state).bonded, std::uint8_t{0});
                    if (stretches) {
                        heap.base.surfaces[1].conveyor = 0.0;
                        heap.base.surfaces[1].stretched_length = 62.0 * 93.1;
                    }
                    CyclePhysics damped = physics;
                    damped.averaging_time = averaging_time;
                    if (averaging_time > 0.0)
                        add_mean_velocities(heap.state);
                    State plain = heap.state;
                    advance(plain, heap.base, damped, 500, {1, Cycle::plain});
                    for (const Cycle cycle : cycles()) {
                        State fast = heap.state;
                        advance(fast, heap.base, damped, 500, {2, cycle});
                        EXPECT_EQ(hash(fast), hash(plain))
                            << name(cycle) << ", stretches " << stretches << ", averaging "
                            << averaging_time << " s, strength " << strength << ", friction "
                            << friction;
                    }
                }
}

/// The wall stops amid the cycles: from there on damping is towards rest, whatever discs remember
/// of their mean motion, and they remember no more of it.
TEST(FastCycle, HasTheSameBitsWhereTheWallRests) {
    CyclePhysics against_mean = physics, against_rest = physics;
    against_mean.averaging_time = 2.0;
    for (const float strength : {-1.0f, 3e9f}) {
        Heap heap(20, strength, 0.3);
        add_mean_velocities(heap.state);
        std::ranges::fill(heap.state.discs.get<float>("mean_vy"), -1.0f);
        constexpr double speed = 1.5, begins = 10.5; // m: they stop after some hundred cycles
        heap.base.motion = {
            .speed = speed,
            .stages = {
                {.end = Travel(begins), .speed = speed},
                {.start = Travel(begins), .end = Travel(1e3), .slope = 0.0, .speed = speed}}};
        State plain = heap.state;
        advance(plain, heap.base, against_mean, 500, {1, Cycle::plain});
        ASSERT_FALSE(stops(heap.base.motion, {}));
        ASSERT_TRUE(stops(heap.base.motion, plain.clock.travel));
        for (const Cycle cycle : cycles()) {
            State fast = heap.state;
            advance(fast, heap.base, against_mean, 500, {2, cycle});
            EXPECT_EQ(hash(fast), hash(plain)) << name(cycle) << ", strength " << strength;
        }
        State still = plain;
        advance(plain, heap.base, against_mean, 100, {1, Cycle::plain});
        advance(still, heap.base, against_rest, 100, {1, Cycle::plain});
        EXPECT_EQ(hash(plain), hash(still)) << "strength " << strength;
    }
}

TEST(FastCycle, GoesOnWhereThePlainOneStopped) {
    Heap heap(20, 3e9f);
    State plain = heap.state, mixed = heap.state;
    advance(plain, heap.base, physics, 1000, {1, Cycle::plain});
    for (int k = 0; k < 10; ++k)
        advance(mixed, heap.base, physics, 100, {2, k % 2 ? Cycle::plain : fast_cycle()});
    EXPECT_EQ(hash(mixed), hash(plain));
}

TEST(FastCycle, NoDiscsAndOneDisc) {
    const RigidBase base = box(1e3, 1e4);
    for (std::size_t count : {0, 1}) {
        State state = make_state(row(count, 50.0));
        state.mean_radius = 50.0;
        state.skin = 12.0;
        state.clock.time_step = 0.001;
        find_contacts(state, base);
        State plain = state;
        advance(state, base, physics, 50, {4, fast_cycle()});
        advance(plain, base, physics, 50, {1, Cycle::plain});
        EXPECT_EQ(hash(state), hash(plain));
        EXPECT_EQ(state.clock.cycle, 50);
    }
}

} // namespace
} // namespace listric::fast_cycle_test
