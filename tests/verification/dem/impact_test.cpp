// Normal impact of two discs without damping is half a period of an oscillator:
//   t_c = pi sqrt(m* / K), greatest overlap v sqrt(m* / K), greatest force v sqrt(m* K),
//   restitution 1, with m* = m / 2 and K the contact's stiffness.
// Contact begins on a step. Leapfrog's amplitude is off by (omega dt)^2 / 8, everything else is of
// the same order: with N steps in contact (pi / N)^2, i.e. 1e-3 for N = 100.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace listric::impact_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1, v = 0.5; // m, m/s
const Material material;
const double mass = density * pi * r * r;

struct Impact {
    double contact_time = 0.0, overlap = 0.0, force = 0.0, restitution = 0.0;
};

/// Two discs that touch approach with 2 v, or one a rigid floor of the same material with v.
Impact impact(int steps, bool floor, const Execution& execution) {
    State state = make_state(floor ? std::vector<Disc>{{0.0, r, r}} : row(2, r), material);
    RigidBase base;
    base.material = material;
    if (floor)
        base.surfaces = {{"floor", {line({-1e3, 0.0}, {1e3, 0.0})}}};
    const DiscColumns d = disc_columns(state);
    d.vx[0] = floor ? 0.0 : v;
    d.vy[0] = floor ? -v : 0.0;
    if (!floor)
        d.vx[1] = -v;
    const double reduced = floor ? mass : 0.5 * mass, stiffness = contact_stiffness(material);
    state.clock.time_step = pi * std::sqrt(reduced / stiffness) / steps;
    const auto overlap = [&] { return floor ? r - d.y[0] : 2.0 * r - (d.x[1] - d.x[0]); };

    Impact result;
    double before = 0.0;
    for (int n = 1; n < 2 * steps; ++n) {
        const double velocity = floor ? d.vy[0] : d.vx[1];
        advance(state, base, {0.0, 0.0}, 1, execution);
        const double now = overlap(), gain = (floor ? d.vy[0] : d.vx[1]) - velocity;
        result.overlap = std::max(result.overlap, now);
        result.force = std::max(result.force, mass * gain / state.clock.time_step);
        if (now <= 0.0 && before > 0.0)
            result.contact_time = (n - 1 + before / (before - now)) * state.clock.time_step;
        before = now;
    }
    result.restitution = floor ? d.vy[0] / v : d.vx[1] / v;
    return result;
}

class Impacts : public testing::TestWithParam<std::tuple<bool, Execution>> {
protected:
    bool floor = std::get<bool>(GetParam());
    Execution execution = std::get<Execution>(GetParam());
    double reduced = floor ? mass : 0.5 * mass;
    double approach = floor ? v : 2.0 * v;
    double stiffness = contact_stiffness(material);
};

TEST_P(Impacts, IsHalfAnOscillation) {
    const Impact i = impact(100, floor, execution);
    EXPECT_NEAR(i.contact_time / (pi * std::sqrt(reduced / stiffness)), 1.0, 1e-3);
    EXPECT_NEAR(i.overlap / (approach * std::sqrt(reduced / stiffness)), 1.0, 1e-3);
    EXPECT_NEAR(i.force / (approach * std::sqrt(reduced * stiffness)), 1.0, 1e-3);
    EXPECT_NEAR(i.restitution, 1.0, 1e-3);
}

TEST_P(Impacts, IsOfSecondOrder) {
    // N even, so that a step falls on the greatest overlap.
    const double exact = approach * std::sqrt(reduced / stiffness);
    double coarse = impact(20, floor, execution).overlap / exact - 1.0;
    EXPECT_NEAR(coarse, pi * pi / 400.0 / 8.0, 0.1 * coarse);
    for (int steps : {40, 80, 160}) {
        const double fine = impact(steps, floor, execution).overlap / exact - 1.0;
        EXPECT_NEAR(coarse / fine, 4.0, 0.1) << steps;
        coarse = fine;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Impacts, testing::Combine(testing::Bool(), every_cycle()),
                         [](const auto& test) {
                             return (std::get<bool>(test.param) ? "floor_" : "discs_") +
                                    name(std::get<Execution>(test.param));
                         });

} // namespace
} // namespace listric::impact_test
