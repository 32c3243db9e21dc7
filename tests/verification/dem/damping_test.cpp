// Local damping F_d = -a |F| sign(v) makes an oscillator a sequence of half cycles: towards rest
// with stiffness K (1 - a), away from it with K (1 + a). Energy balance and times give
//   amplitude ratio of successive peaks sqrt((1 - a) / (1 + a)), 0.420 at a = 0.7;
//   half period (pi / 2) (1 / sqrt(1 - a) + 1 / sqrt(1 + a)) sqrt(m* / K).
// The damping force jumps where the velocity changes sign, known to half a step only: an error of
// first order in dt, below 1 % with 1000 steps in the shortest quarter cycle.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

namespace listric::damping_test {

using namespace dem;
namespace {

using namespace support;

class Damping : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Damping, every_cycle(), cycle_name);

constexpr double r = 93.1;

struct Peak {
    double time, amplitude;
};

/// Peaks of a bonded pair released one centimetre apart.
std::vector<Peak> peaks(double damping, std::size_t count, const Execution& execution) {
    const Material material;
    State state = make_state(row(2, r), material);
    bond_all(state, {});
    const DiscColumns d = disc_columns(state);
    d.x[1] += 0.01;
    state.clock.time_step = 1e-3 * std::sqrt(0.5 * d.mass[0] / contact_stiffness(material));
    std::vector<Peak> found{{0.0, 0.01}};
    double before = 0.01, now = 0.01;
    while (found.size() < count) {
        advance(state, {}, {damping, 0.0}, 1, execution);
        const double next = d.x[1] - d.x[0] - 2.0 * r;
        if ((now - before) * (next - now) < 0.0)
            found.push_back(
                {static_cast<double>(state.clock.cycle - 1) * state.clock.time_step, now});
        before = now;
        now = next;
    }
    return found;
}

TEST_P(Damping, AmplitudesAndPeriod) {
    const Material material;
    const double unit = std::sqrt(0.5 * density * pi * r * r / contact_stiffness(material));
    for (double a : {0.2, 0.5, 0.7}) {
        const double ratio = std::sqrt((1.0 - a) / (1.0 + a));
        const double half = 0.5 * pi * (1.0 / std::sqrt(1.0 - a) + 1.0 / std::sqrt(1.0 + a)) * unit;
        const std::vector<Peak> p = peaks(a, 5, GetParam());
        for (std::size_t k = 1; k < p.size(); ++k) {
            EXPECT_NEAR(p[k].amplitude / p[k - 1].amplitude, -ratio, 0.01 * ratio) << a;
            EXPECT_NEAR(p[k].time - p[k - 1].time, half, 0.01 * half) << a;
        }
    }
    EXPECT_NEAR(std::sqrt(0.3 / 1.7), 0.420, 5e-4);
}

TEST_P(Damping, NoneKeepsTheAmplitude) {
    const std::vector<Peak> p = peaks(0.0, 5, GetParam());
    EXPECT_NEAR(p.back().amplitude, 0.01, 1e-7);
}

TEST_P(Damping, FreeFallIsSlowedByItsShare) {
    // From rest at the first step, undamped; then (1 - a) g.
    State state = make_state({{0.0, 0.0, r}});
    state.clock.time_step = 0.01;
    advance(state, {}, {0.7, 9.81}, 101, GetParam());
    EXPECT_NEAR(disc_columns(state).vy[0], -9.81 * (0.01 + 0.3), 1e-12);
}

TEST_P(Damping, DoesNotHoldBackWhatMovesWithAStretchingBase) {
    // A bonded pair vibrates while it moves as a point of the base: x grows in proportion to the
    // base's length, so its speed is constant. The vibration, 0.01 m at 50 m/s, is a hundred
    // thousand times faster than the base's difference across the pair and loses no momentum to it;
    // damped against x itself, the pair would lose a third of its 1 m/s within the run.
    const Material material;
    std::vector<Disc> discs = row(2, r);
    for (Disc& disc : discs)
        disc.x += 1e4;
    State state = make_state(discs, material);
    bond_all(state, {});
    const DiscColumns d = disc_columns(state);
    d.x[1] += 0.01;
    const double middle = 0.5 * (d.x[0] + d.x[1]);
    RigidBase base;
    base.surfaces = {{"base", {line({0.0, -1e3}, {1e5, -1e3})}, 0.0, 0.0, {}, 2e4}};
    base.motion = {2.0, 0.0};
    const double speed = 2.0 * middle / 2e4;
    d.vx[0] = d.vx[1] = speed;
    state.clock.time_step = 1e-3 * std::sqrt(0.5 * d.mass[0] / contact_stiffness(material));
    advance(state, base, {0.7, 0.0}, 4000, GetParam());
    EXPECT_NEAR(0.5 * (d.vx[0] + d.vx[1]), speed, 1e-3 * speed);
}

} // namespace
} // namespace listric::damping_test
