// A contact bond holds while -F_n <= tensile strength and |F_s| <= shear strength; friction does
// not limit it. In the cycle where a force first exceeds its strength the bond goes, and then
//   after tension  F_n = F_s = 0,
//   after shear    F_n stays, F_s is clipped to mu F_n; both are 0 if F_n was tensile.
// Discs are so heavy that they do not feel the forces: the overlap and the shear displacement are
// prescribed. With overlaps near 0.1 m at radii of 1 m round-off is 1e-14 of the force, and 1e-12
// decides a break.

#include "dem/cycle/cycle.hpp"
#include "dem/law.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

namespace listric::bond_break_test {

using namespace dem;
namespace {

using namespace support;

class BondBreak : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, BondBreak, every_cycle(), cycle_name);

constexpr double K = 1024.0, Ks = 512.0, step = 1.0 / 1024.0;

/// A bonded pair of radius 1 with the given overlap and friction.
struct HeavyPair {
    Execution execution;
    State state;

    HeavyPair(const Execution& how, double overlap, double friction, float tensile, float shear)
        : execution(how), state(make_state({{0.0, 0.0, 1.0}, {2.0 - overlap, 0.0, 1.0}},
                                           {2.0 * K, 2.0 * Ks, friction, true})) {
        state.inertial_mass_floor = 1e30;
        state.clock.time_step = step;
        find_contacts(state, {});
        bond(state, 0, tensile, shear);
    }
    void cycle() { advance(state, {}, {0.0, 0.0}, 1, execution); }
    /// Normal force in the next cycle, from what it does to the discs' own mass. The pair itself
    /// does not advance.
    double normal() {
        State light = state;
        light.inertial_mass_floor = 0.0;
        const DiscColumns d = disc_columns(light);
        for (std::size_t i : {0, 1})
            d.vx[i] = d.vy[i] = d.spin[i] = 0.0;
        advance(light, {}, {0.0, 0.0}, 1, execution);
        EXPECT_NEAR(d.mass[0] * d.vx[0], -d.mass[1] * d.vx[1], 1e-12 * K * step);
        return d.mass[1] * d.vx[1] / step;
    }
    bool bonded() { return contact_columns(state).bonded[0] == 1; }
    double shear() { return contact_columns(state).shear_force[0]; }
    DiscColumns discs() { return disc_columns(state); }
};

TEST_P(BondBreak, TensionAtTheStrengthToTwelveDigits) {
    const double stretch = 128.0 / K; // 0.125 m
    for (double excess : {-1e-12, 0.0, 1e-12}) {
        HeavyPair p(GetParam(), -stretch * (1.0 + excess), 0.5, 128.0f, 1e6f);
        contact_columns(p.state).shear_force[0] = 10.0;
        EXPECT_NEAR(p.normal(), excess <= 0.0 ? -128.0 : 0.0, 1e-9) << excess; // at once
        p.cycle();
        EXPECT_EQ(p.bonded(), excess <= 0.0) << excess;
        EXPECT_EQ(p.shear(), excess <= 0.0 ? 10.0 : 0.0) << excess;
        EXPECT_NEAR(p.normal(), excess <= 0.0 ? -128.0 : 0.0, 1e-9) << excess;
    }
}

TEST_P(BondBreak, TensionRampedUp) {
    // 0.01 m/s apart: K v dt = 0.01 N per cycle, so 128 N are passed in cycle 12801; half a
    // cycle's margin against rounding of the sum of displacements.
    HeavyPair p(GetParam(), 0.0, 0.5, 128.005f, 1e6f);
    p.discs().vx[1] = 0.01;
    int cycles = 0;
    while (p.bonded() && cycles < 20000) {
        p.cycle();
        ++cycles;
    }
    // The first cycle sees no stretch yet.
    EXPECT_EQ(cycles, 12802);
    EXPECT_EQ(p.normal(), 0.0);
}

TEST_P(BondBreak, ShearAtTheStrengthToTwelveDigits) {
    for (double sign : {-1.0, 1.0})
        for (double excess : {-1e-12, 0.0, 1e-12}) {
            HeavyPair p(GetParam(), 0.125, 0.5, 1e6f, 100.0f);
            const double force = sign * 100.0 * (1.0 + excess);
            contact_columns(p.state).shear_force[0] = force;
            EXPECT_NEAR(p.normal(), 128.0, 1e-9) << force;
            p.cycle();
            EXPECT_EQ(p.bonded(), excess <= 0.0) << force;
            EXPECT_NEAR(p.shear(), excess <= 0.0 ? force : sign * 64.0, 1e-9) << force;
            EXPECT_NEAR(p.normal(), 128.0, 1e-9) << force;
        }
}

TEST_P(BondBreak, ShearUnderTensionLeavesNoForce) {
    // Nothing carries the shear force on, and the tension goes with the bond, though it was below
    // the tensile strength.
    HeavyPair p(GetParam(), -0.125, 0.5, 1e6f, 100.0f);
    contact_columns(p.state).shear_force[0] = 99.0;
    p.cycle();
    EXPECT_TRUE(p.bonded());
    EXPECT_EQ(p.shear(), 99.0);
    EXPECT_NEAR(p.normal(), -128.0, 1e-9);
    contact_columns(p.state).shear_force[0] = 101.0;
    EXPECT_EQ(p.normal(), 0.0);
    p.cycle();
    EXPECT_FALSE(p.bonded());
    EXPECT_EQ(p.shear(), 0.0);
    EXPECT_EQ(p.normal(), 0.0);
}

TEST_P(BondBreak, NotInCompression) {
    // A hundred times the tensile strength.
    HeavyPair p(GetParam(), 0.125, 0.5, 1.28f, 100.0f);
    p.cycle();
    EXPECT_TRUE(p.bonded());
    EXPECT_NEAR(p.normal(), 128.0, 1e-9);
}

/// Shears the pair by spinning both discs alike, which leaves the geometry alone.
std::vector<double> sheared(HeavyPair& p, int cycles) {
    p.discs().spin[0] = p.discs().spin[1] = 1.0;
    std::vector<double> force;
    for (int n = 0; n < cycles; ++n) {
        p.cycle();
        force.push_back(p.shear());
    }
    return force;
}

TEST_P(BondBreak, ShearThatFrictionCannotCarry) {
    // Overlap 0.125 m: F_n = 128 N, mu F_n = 64 N; the bond holds 100 N. Arms are 2 m less the
    // overlap in sum, so the force grows by Ks dt * 1.875 = 0.9375 N per cycle: 106 cycles hold.
    HeavyPair p(GetParam(), 0.125, 0.5, 1e6f, 100.0f);
    const std::vector<double> force = sheared(p, 150);
    for (std::size_t n = 0; n < 106; ++n)
        ASSERT_NEAR(force[n], 0.9375 * static_cast<double>(n + 1), 1e-9);
    for (std::size_t n = 106; n < 150; ++n)
        ASSERT_NEAR(force[n], 64.0, 1e-9);
    EXPECT_FALSE(p.bonded());
    EXPECT_NEAR(p.normal(), 128.0, 1e-9);
}

TEST_P(BondBreak, ShearThatFrictionCarriesOn) {
    // mu = 1: mu F_n = 128 N lies above the bond's 100 N, which the force passes without a step.
    HeavyPair p(GetParam(), 0.125, 1.0, 1e6f, 100.0f);
    const std::vector<double> force = sheared(p, 150);
    for (std::size_t n = 0; n < 136; ++n)
        ASSERT_NEAR(force[n], 0.9375 * static_cast<double>(n + 1), 1e-9);
    for (std::size_t n = 136; n < 150; ++n)
        ASSERT_NEAR(force[n], 128.0, 1e-9);
    EXPECT_FALSE(p.bonded());
    EXPECT_NEAR(p.normal(), 128.0, 1e-9);
}

TEST_P(BondBreak, NoMomentInTheBond) {
    // Discs that roll on each other like gears feel nothing, bonded or not.
    HeavyPair p(GetParam(), 0.125, 0.5, 1e6f, 1e-3f);
    p.discs().spin[0] = 1.0;
    p.discs().spin[1] = -1.0;
    for (int n = 0; n < 100; ++n)
        p.cycle();
    EXPECT_TRUE(p.bonded());
    EXPECT_NEAR(p.shear(), 0.0, 1e-12);
}

} // namespace
} // namespace listric::bond_break_test
