// Discs on an incline of dip b and on the flat, undamped:
//   sliding without spin     a = g (sin b - mu cos b);
//   rolling, tan b <= 3 mu   a = 2/3 g sin b;
//   else slip with spin-up   a = g (sin b - mu cos b), spin rate 2 mu g cos b / r;
//   thrown along the flat    slip ends at t = v_0 / (3 mu g) with v = 2/3 v_0.
// The contact is a spring: the start is not quite static, and the shear spring swings about its
// mean. Both change distances by less than one contact period (2 ms here) in the second that is
// looked at: 1 %.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::friction_test {

using namespace dem;
namespace {

using namespace support;

class Friction : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Friction, every_cycle(), cycle_name);

constexpr double g = 9.81, r = 1.0, seconds = 1.0, step = 2e-5;

/// A disc, or a triangle of bonded discs with one side down, on a plane that dips to the right.
struct Incline {
    State state;
    RigidBase base;
    Point down, normal;
    Execution execution;

    Incline(double dip, double friction, bool triangle, const Execution& how)
        : down{std::cos(dip), -std::sin(dip)}, normal{std::sin(dip), std::cos(dip)},
          execution(how) {
        base.surfaces = {{"plane",
                          {line({-1e3 * down.x, -1e3 * down.y}, {1e3 * down.x, 1e3 * down.y})},
                          friction}};
        const double mass = density * pi * r * r;
        const double sink =
            (triangle ? 1.5 : 1.0) * mass * g * std::cos(dip) / contact_stiffness(base.material);
        std::vector<Disc> start;
        const auto add = [&](double along, double height) {
            start.push_back({along * down.x + (height - sink) * normal.x,
                             along * down.y + (height - sink) * normal.y, r});
        };
        add(0.0, r);
        if (triangle) {
            add(2.0 * r, r);
            add(r, r + std::sqrt(3.0) * r);
        }
        state = make_state(start);
        state.clock.time_step = step;
        bond_all(state, base);
    }
    void run(double time) { advance(state, base, {0.0, g}, std::llround(time / step), execution); }
    double travelled() {
        const DiscColumns d = disc_columns(state);
        return (d.x[0] - d.start_x[0]) * down.x + (d.y[0] - d.start_y[0]) * down.y;
    }
};

TEST_P(Friction, BlockSlides) {
    // Three bonded discs cannot spin: two would turn like gears.
    const double dip = pi / 6.0, mu = 0.3;
    Incline i(dip, mu, true, GetParam());
    i.run(seconds);
    const double a = g * (std::sin(dip) - mu * std::cos(dip));
    EXPECT_NEAR(i.travelled(), 0.5 * a, 0.01 * 0.5 * a);
    // Friction sets in at once and loads the front disc: undamped, the block then rocks and hops a
    // little, a hundredth of the way at most. A disc alone would turn by 1.6.
    EXPECT_NEAR(disc_columns(i.state).rotation[0], 0.0, 0.01 * 0.5 * a / r);
}

TEST_P(Friction, IsTheWallsOrTheSmallerOfWallAndDisc) {
    const double dip = pi / 4.0, disc = 0.3;
    for (const double wall : {0.5, 0.1})
        for (const FrictionRule rule : {FrictionRule::wall, FrictionRule::smaller}) {
            Incline i(dip, wall, true, GetParam());
            i.state.materials[basement].friction = disc;
            i.base.surfaces[0].friction_rule = rule;
            i.run(seconds);
            const double mu = rule == FrictionRule::wall ? wall : std::min(wall, disc);
            const double a = g * (std::sin(dip) - mu * std::cos(dip));
            EXPECT_NEAR(i.travelled(), 0.5 * a, 0.01 * 0.5 * a) << wall;
        }
}

TEST_P(Friction, BlockStays) {
    const double dip = pi / 18.0; // tan 10 degrees = 0.176
    Incline i(dip, 0.5, true, GetParam());
    i.run(seconds);
    EXPECT_NEAR(i.travelled(), 0.0, 1e-4); // elastic shear of the contact
}

TEST_P(Friction, DiscRolls) {
    const double dip = pi / 9.0; // tan 20 degrees = 0.364 < 3 mu
    Incline i(dip, 0.3, false, GetParam());
    i.run(seconds);
    const double expected = 0.5 * 2.0 / 3.0 * g * std::sin(dip);
    EXPECT_NEAR(i.travelled(), expected, 0.01 * expected);
    EXPECT_NEAR(-disc_columns(i.state).rotation[0] * r, expected, 0.01 * expected);
}

TEST_P(Friction, DiscSlipsAndSpinsUp) {
    const double dip = pi / 6.0, mu = 0.1; // tan 30 degrees = 0.577 > 3 mu
    Incline i(dip, mu, false, GetParam());
    i.run(seconds);
    const double a = g * (std::sin(dip) - mu * std::cos(dip));
    EXPECT_NEAR(i.travelled(), 0.5 * a, 0.01 * 0.5 * a);
    const double spin = 2.0 * mu * g * std::cos(dip) / r;
    EXPECT_NEAR(-disc_columns(i.state).spin[0], spin, 0.01 * spin);
}

TEST_P(Friction, ThrownDiscEndsRolling) {
    const double mu = 0.2, v = 3.0, end = v / (3.0 * mu * g);
    Incline before(0.0, mu, false, GetParam()), after(0.0, mu, false, GetParam());
    for (Incline* i : {&before, &after})
        disc_columns(i->state).vx[0] = v;
    before.run(0.95 * end);
    const DiscColumns b = disc_columns(before.state);
    EXPECT_NEAR(b.vx[0], v - mu * g * 0.95 * end, 0.01 * v);
    EXPECT_GT(b.vx[0] + b.spin[0] * r, 0.02 * v); // still slips
    after.run(1.5 * end);
    const DiscColumns a = disc_columns(after.state);
    EXPECT_NEAR(a.vx[0], 2.0 / 3.0 * v, 0.01 * v);
    EXPECT_NEAR(-a.spin[0] * r, 2.0 / 3.0 * v, 0.01 * v);
}

TEST_P(Friction, ConveyorTakesTheDiscAlong) {
    // Thrown from a moving base's point of view: the disc ends with a third of its speed.
    Incline i(0.0, 0.2, false, GetParam());
    i.base.surfaces[0].conveyor = 1.0;
    i.base.motion.speed = 3.0;
    i.run(1.5 * 3.0 / (3.0 * 0.2 * g));
    EXPECT_NEAR(disc_columns(i.state).vx[0], 1.0, 0.03);
}

/// A disc that cannot roll is carried by a stretching base as a point of it: its distance from the
/// fixed end grows in proportion to the base's length. Friction brings it to the base's speed of
/// 0.5 m/s within a tenth of a second: centimetres in the 1,000 m that it goes.
TEST_P(Friction, AStretchingBaseCarriesWhatRestsOnIt) {
    // Two discs bonded side by side do not roll.
    const double start = 5e3, length = 1e4, speed = 1.0;
    std::vector<Disc> discs = row(2, 100.0);
    for (Disc& disc : discs) {
        disc.x += start - 100.0;
        disc.y += 99.99;
    }
    RigidBase base;
    base.surfaces = {{"base", {line({0.0, 0.0}, {1e5, 0.0})}, 0.5, 0.0, {}, length}};
    base.motion = {speed, 0.0};
    State state = make_state(discs);
    bond_all(state, base);
    const DiscColumns d = disc_columns(state);
    state.clock.time_step = 0.01;
    advance(state, base, {0.7, g}, 200000, GetParam());
    const double grown = state.clock.extension.m / length;
    EXPECT_NEAR(0.5 * (d.x[0] + d.x[1]) - start, start * grown, 1e-3 * start * grown);
    EXPECT_GT(grown, 0.1);
}

} // namespace
} // namespace listric::friction_test
