// Resistance of contacts to rolling. A disc on a plane of dip b with mu_r below friction
//   rests up to tan b = mu_r;
//   beyond it rolls with a = 2/3 g (sin b - mu_r cos b);
//   thrown along the flat it stops after 3 v^2 / (4 mu_r g), where all its energy is lost.
// The contact is a spring: distances differ by less than one of its periods in the time looked at.

#include "dem/contacts/energy.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/rolling.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::rolling_test {

using namespace dem;
namespace {

using namespace support;

class Rolling : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Rolling, every_cycle(), cycle_name);

constexpr double g = 9.81, r = 1.0, step = 2e-5, mu_r = 0.2;

Material resisting(double rolling_friction, double friction = 0.6) {
    Material material{1.7e11, 6.38e10, friction, true};
    material.rolling_friction = rolling_friction;
    return material;
}

/// A disc on a plane that dips to the right.
struct Incline {
    State state;
    RigidBase base;
    Point down;
    CyclePhysics physics;

    explicit Incline(double slope, double damping, double friction = 0.6)
        : down{1.0 / std::sqrt(1.0 + slope * slope), -slope / std::sqrt(1.0 + slope * slope)},
          physics{damping, g} {
        base.surfaces = {{"plane",
                          {line({-1e3 * down.x, -1e3 * down.y}, {1e3 * down.x, 1e3 * down.y})},
                          friction}};
        const double sink = density * pi * r * r * g * down.x / contact_stiffness(base.material);
        state = make_state({{-(r - sink) * down.y, (r - sink) * down.x, r}}, resisting(mu_r));
        state.clock.time_step = step;
        find_contacts(state, base);
    }
    void run(double time, const Execution& execution = {}) {
        advance(state, base, physics, std::llround(time / step), execution);
    }
    double travelled() const {
        const ConstDiscColumns d = disc_columns(state);
        return (d.x[0] - d.start_x[0]) * down.x + (d.y[0] - d.start_y[0]) * down.y;
    }
};

TEST_P(Rolling, RestsOnTheSlopeWhoseTangentItIs) {
    Incline rests(0.999 * mu_r, 0.7), rolls(1.001 * mu_r, 0.0);
    for (Incline* incline : {&rests, &rolls})
        incline->run(0.5, GetParam());
    const double at_rest = rests.travelled(), half_way = rolls.travelled();
    for (Incline* incline : {&rests, &rolls})
        incline->run(0.5, GetParam());
    EXPECT_NEAR(rests.travelled(), at_rest, 1e-12);
    // The start, which is not static, gives it some speed.
    const double gain = rolls.travelled() - 2.0 * half_way, a = 2.0 / 3.0 * g * 0.001 * mu_r;
    EXPECT_NEAR(gain, 0.25 * a * rolls.down.x, 0.02 * 0.25 * a);
}

TEST_P(Rolling, RollsBeyond) {
    Incline incline(2.0 * mu_r, 0.0);
    incline.run(1.0, GetParam());
    const double a = 2.0 / 3.0 * g * mu_r * incline.down.x; // sin b - mu_r cos b = mu_r cos b
    EXPECT_NEAR(incline.travelled(), 0.5 * a, 0.01 * 0.5 * a);
    EXPECT_NEAR(disc_columns(incline.state).rotation[0], -incline.travelled() / r, 1e-3);
}

TEST_P(Rolling, IsNoMoreThanFriction) {
    // On a smooth plane nothing holds a disc that spins.
    Incline incline(0.0, 0.0, 0.0);
    disc_columns(incline.state).spin[0] = 1.0;
    incline.run(0.1, GetParam());
    EXPECT_EQ(disc_columns(incline.state).spin[0], 1.0);
}

TEST(Rolling, StopsADiscAndTakesItsEnergy) {
    constexpr double v = 1.0;
    Incline incline(0.0, 0.0);
    const DiscColumns d = disc_columns(incline.state);
    d.vx[0] = v;
    d.spin[0] = -v / r;
    EnergyFlows flows;
    const auto energy = [&] {
        const StoredEnergy stored = stored_energy(incline.state, incline.base, g);
        return stored.motion_and_strain() + stored.potential;
    };
    const double before = energy(), kinetic = 0.75 * d.mass[0] * v * v;
    double last = before;
    for (int k = 0; k < 100; ++k) {
        incline.run(0.02, {.energy = &flows});
        EXPECT_LE(energy(), last + 1e-12 * before);
        last = energy();
    }
    EXPECT_NEAR(incline.travelled(), 3.0 * v * v / (4.0 * mu_r * g), 1e-2 * incline.travelled());
    EXPECT_NEAR(flows.friction, kinetic, 1e-3 * kinetic);
    EXPECT_NEAR(last + flows.friction + flows.stepping, before, 1e-9 * kinetic);
}

/// A disturbed lattice, partly bonded, thrown about in a box whose floor runs.
struct Heap {
    RigidBase base = box(62.0 * 93.1, 1e5, 0.4);
    State state;

    explicit Heap(float strength, double rolling_friction = 0.3) {
        std::vector<Disc> discs = cloud(28, 20, 93.1, 7);
        for (Disc& disc : discs) {
            disc.x += 300.0;
            disc.y += 150.0;
        }
        state = make_state(discs, resisting(rolling_friction));
        sort_discs(state);
        bond_all(state, base, strength);
        if (strength < 0.0f)
            std::ranges::fill(contact_columns(state).bonded, std::uint8_t{0});
        state.clock.time_step = 0.006;
        base.surfaces[1].conveyor = 1.0;
        base.surfaces[2].translation = {1.0, 0.0};
        base.motion = {1.5, 3.0};
    }
};

TEST(Rolling, HasTheSameBitsInEveryCycle) {
    for (const float strength : {-1.0f, 3e9f})
        for (const double averaging_time : {0.0, 2.0}) {
            Heap heap(strength);
            const CyclePhysics physics{0.7, g, averaging_time};
            if (averaging_time > 0.0)
                add_mean_velocities(heap.state);
            State plain = heap.state, halves = heap.state;
            advance(plain, heap.base, physics, 500, {1, Cycle::plain});
            for (const Cycle cycle : cycles())
                for (const int threads : {1, 3}) {
                    State fast = heap.state;
                    advance(fast, heap.base, physics, 500, {threads, cycle});
                    EXPECT_EQ(hash(fast), hash(plain)) << name(cycle) << ", " << threads;
                }
            for (int k = 0; k < 2; ++k)
                advance(halves, heap.base, physics, 250, {2, fast_cycle()});
            EXPECT_EQ(hash(halves), hash(plain));
            const auto moments = rolling_moments(std::as_const(plain.contacts));
            const auto bonded = contact_columns(plain).bonded;
            EXPECT_GT(std::ranges::count_if(moments, [](double m) { return m != 0.0; }), 100);
            for (std::size_t k = 0; k < moments.size(); ++k)
                EXPECT_TRUE(moments[k] == 0.0 || !bonded[k]);
        }
}

TEST(Rolling, HasNoMemoryWhereNothingResists) {
    Heap heap(3e9f, 0.0);
    advance(heap.state, heap.base, {0.7, g}, 10);
    EXPECT_FALSE(resists_rolling(heap.state));
}

TEST(Rolling, MomentsTurnRoundWithTheirDiscs) {
    Heap heap(-1.0f);
    advance(heap.state, heap.base, {0.7, g}, 500);
    State turned = heap.state;
    std::vector<std::int32_t> order(turned.discs.rows());
    std::iota(order.rbegin(), order.rend(), 0);
    reorder_discs(turned, order);
    const auto moments = rolling_moments(std::as_const(heap.state.contacts)),
               after = rolling_moments(std::as_const(turned.contacts));
    const auto rows = static_cast<std::int32_t>(order.size());
    const ConstContactColumns c = contact_columns(std::as_const(heap.state));
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const std::size_t now =
            find_pair(turned, disc_columns(heap.state).id[static_cast<std::size_t>(c.first[k])],
                      disc_columns(heap.state).id[static_cast<std::size_t>(c.second[k])]);
        EXPECT_EQ(contact_columns(turned).first[now], rows - 1 - c.second[k]);
        EXPECT_EQ(after[now], -moments[k]);
    }
}

TEST(Rolling, EnergyGoesWhereTheAccountSays) {
    Heap heap(-1.0f);
    heap.base.motion = {};
    heap.base.surfaces[1].conveyor = 0.0;
    heap.state.clock.time_step = 0.002;
    const auto energy = [&] {
        const StoredEnergy stored = stored_energy(heap.state, heap.base, g);
        return stored.motion_and_strain() + stored.potential;
    };
    const double before = energy();
    EnergyFlows flows;
    advance(heap.state, heap.base, {0.0, g}, 2000, {.energy = &flows});
    EXPECT_GT(flows.friction, 0.0);
    EXPECT_LT(energy(), before);
    EXPECT_NEAR(energy() + flows.friction + flows.stepping, before, 1e-3 * (before - energy()));
}

} // namespace
} // namespace listric::rolling_test
