// Constant forces on discs: in every cycle to the same bits, in the balance of forces and in the
// loads of layers. Without the columns there is nothing: recorded hashes hold that.

#include "dem/contacts/energy.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/pushes.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::pushes_test {

using namespace dem;
namespace {

using namespace support;

struct PushedHeap {
    RigidBase base = box(62.0 * 93.1, 1e5, 0.4);
    State state;

    explicit PushedHeap(double share) {
        std::vector<Disc> discs = cloud(28, 30, 93.1, 7);
        for (Disc& disc : discs) {
            disc.x += 300.0;
            disc.y += 150.0;
        }
        state = make_state(discs, Material{1.7e11, 6.38e10, 0.3, true});
        sort_discs(state);
        bond_all(state, base, 3e9f);
        state.clock.time_step = 0.006;
        base.surfaces[1].conveyor = 1.0;
        base.motion = {1.5, 3.0};
        add_pushes(state);
        Random random(11);
        const auto x = state.discs.get<double>("push_x"), y = state.discs.get<double>("push_y");
        for (std::size_t i = 0; i < x.size(); ++i)
            if (random.between(0.0, 1.0) < share) {
                const double weight = disc_columns(state).mass[i] * 9.81;
                x[i] = weight * random.between(-0.3, 0.3);
                y[i] = weight * random.between(0.0, 0.9);
            }
    }
};

constexpr CyclePhysics physics{0.7, 9.81};

TEST(Pushes, HaveTheSameBitsInEveryCycle) {
    for (const double share : {0.0, 0.5, 1.0}) {
        const PushedHeap heap(share);
        State plain = heap.state, unpushed = heap.state;
        advance(plain, heap.base, physics, 1000, {1, Cycle::plain});
        for (const int threads : {1, 2, 3})
            for (const Cycle cycle : cycles()) {
                State fast = heap.state;
                advance(fast, heap.base, physics, 1000, {threads, cycle});
                EXPECT_EQ(hash(fast), hash(plain)) << share << ", " << name(cycle);
            }
        for (const char* column : {"push_x", "push_y"})
            std::ranges::fill(unpushed.discs.get<double>(column), 0.0);
        advance(unpushed, heap.base, physics, 1000);
        for (State* state : {&unpushed, &plain})
            for (const char* column : {"push_x", "push_y"})
                state->discs.remove(column);
        EXPECT_EQ(hash(unpushed) == hash(plain), share == 0.0);
    }
}

TEST(Pushes, AreForces) {
    // One disc in free flight: acceleration is force over mass, which a step rounds some times.
    State state = make_state({{0.0, 0.0, 50.0}});
    add_pushes(state);
    const double mass = disc_columns(state).mass[0];
    state.discs.get<double>("push_x")[0] = 2.0 * mass;
    state.discs.get<double>("push_y")[0] = 9.81 * mass + 3.0 * mass;
    state.clock.time_step = 0.01;
    find_contacts(state, {});
    advance(state, {}, {0.0, 9.81}, 1);
    EXPECT_NEAR(disc_columns(state).vx[0], 0.02, 1e-15);
    EXPECT_NEAR(disc_columns(state).vy[0], 0.03, 1e-15);
}

TEST(Pushes, CountInTheBalanceOfForces) {
    State state = make_state({{0.0, 0.0, 50.0}});
    add_pushes(state);
    const double weight = disc_columns(state).mass[0] * 9.81;
    state.discs.get<double>("push_y")[0] = 0.25 * weight;
    const ForceBalance balance = force_balance(state, {}, 9.81);
    EXPECT_NEAR(balance.weight, 0.75 * weight, 1e-12 * weight);
    EXPECT_NEAR(balance.max_unbalanced, 0.75 * weight, 1e-12 * weight);
}

TEST(Pushes, HaveAPotential) {
    State state = make_state({{3.0, 4.0, 50.0}});
    state.clock.time_step = 0.01;
    EXPECT_EQ(stored_energy(state, {}, 9.81).push_potential, 0.0);
    add_pushes(state);
    state.discs.get<double>("push_x")[0] = 10.0;
    state.discs.get<double>("push_y")[0] = 100.0;
    EXPECT_DOUBLE_EQ(stored_energy(state, {}, 9.81).push_potential, -430.0);
}

} // namespace
} // namespace listric::pushes_test
