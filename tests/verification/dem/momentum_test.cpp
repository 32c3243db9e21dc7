// A free bonded cluster without gravity and damping keeps momentum and angular momentum
//   sum m v,  sum m (x v_y - y v_x) + 1/2 m r^2 spin
// to round-off: forces come in pairs at one place, and leapfrog moves along the velocity. Each
// step rounds to 1e-16 of what moves, so 1e4 steps stay below 1e-12 even if errors add up.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::momentum_test {

using namespace dem;
namespace {

using namespace support;

class Momentum : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Momentum, every_cycle(), cycle_name);

struct Total {
    double x = 0.0, y = 0.0, angular = 0.0, size = 0.0, angular_size = 0.0;
};

Total momentum(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    Total sum;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double m = d.mass[i];
        sum.x += m * d.vx[i];
        sum.y += m * d.vy[i];
        sum.angular += m * (d.x[i] * d.vy[i] - d.y[i] * d.vx[i]) +
                       0.5 * m * d.radius[i] * d.radius[i] * d.spin[i];
        sum.size += m * std::hypot(d.vx[i], d.vy[i]);
        sum.angular_size += m * std::hypot(d.x[i], d.y[i]) * std::hypot(d.vx[i], d.vy[i]);
    }
    return sum;
}

/// A relaxed cluster, bonded with the given strength, whose discs fly apart or at each other.
State cluster(float strength, const Execution& execution) {
    State state = make_state(cloud(14, 14, 93.1, 2));
    bond_all(state, {});
    state.clock.time_step = 0.004;
    advance(state, {}, {0.7, 0.0}, 5000, execution);
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (c.bonded[k])
            bond(state, k, strength, strength);
    Random random(9);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.vx[i] = 0.3 + random.between(-1.0, 1.0);
        d.vy[i] = -0.2 + random.between(-1.0, 1.0);
        d.spin[i] = random.between(-0.01, 0.01);
    }
    return state;
}

void expect_conserved(State& state, const Execution& execution) {
    const Total before = momentum(state);
    const std::vector<double> v(disc_columns(state).vx.begin(), disc_columns(state).vx.end());
    advance(state, {}, {0.0, 0.0}, 10000, execution);
    const Total after = momentum(state);
    // Stress that is left in the cluster may set discs in faster motion than they had.
    const double size = std::max(before.size, after.size);
    EXPECT_NEAR(after.x, before.x, 1e-12 * size);
    EXPECT_NEAR(after.y, before.y, 1e-12 * size);
    EXPECT_NEAR(after.angular, before.angular,
                1e-12 * std::max(before.angular_size, after.angular_size));
    // The discs did exchange it.
    double exchanged = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i)
        exchanged = std::max(exchanged, std::abs(disc_columns(state).vx[i] - v[i]));
    EXPECT_GT(exchanged, 0.1);
}

TEST_P(Momentum, IsKeptByBondedDiscs) {
    State state = cluster(1e30f, GetParam());
    expect_conserved(state, GetParam());
    EXPECT_GT(std::ranges::count(contact_columns(state).bonded, 1), 196);
}

TEST_P(Momentum, IsKeptWhileBondsBreak) {
    State state = cluster(1e9f, GetParam());
    const auto before = std::ranges::count(contact_columns(state).bonded, 1);
    expect_conserved(state, GetParam());
    EXPECT_LT(std::ranges::count(contact_columns(state).bonded, 1), before / 2);
}

} // namespace
} // namespace listric::momentum_test
