// Bonds break in the cycle where the force first exceeds the strength. Discs are so heavy that
// they do not feel the forces: the overlap and the shear displacement are prescribed. With
// overlaps near 0.1 m at radii of 1 m round-off is 1e-14 of the force, and 1e-12 decides a break.

#include "dem/cycle.hpp"
#include "dem/law.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric {
namespace {

using namespace support;

constexpr double K = 1024.0, Ks = 512.0, step = 1.0 / 1024.0;

/// A bonded pair of radius 1 with the given overlap and friction.
struct HeavyPair {
    State state;

    HeavyPair(double overlap, double friction, float tensile, float shear)
        : state(make_state({{0.0, 0.0, 1.0}, {2.0 - overlap, 0.0, 1.0}},
                           {2.0 * K, 2.0 * Ks, friction, true})) {
        state.inertial_mass_floor = 1e30;
        state.clock.time_step = step;
        find_contacts(state, {});
        bond(state, 0, tensile, shear);
    }
    void cycle() { advance(state, {}, {0.0, 0.0}, 1); }
    bool bonded() { return contact_columns(state).bonded[0] == 1; }
    double shear() { return contact_columns(state).shear_force[0]; }
    DiscColumns discs() { return disc_columns(state); }
};

TEST(BondBreak, TensionAtTheStrengthToTwelveDigits) {
    const double stretch = 128.0 / K; // 0.125 m
    for (double excess : {-1e-12, 0.0, 1e-12}) {
        HeavyPair p(-stretch * (1.0 + excess), 0.5, 128.0f, 1e6f);
        contact_columns(p.state).shear_force[0] = 10.0;
        p.cycle();
        EXPECT_EQ(p.bonded(), excess <= 0.0) << excess;
        EXPECT_EQ(p.shear(), excess <= 0.0 ? 10.0 : 0.0) << excess;
    }
}

TEST(BondBreak, TensionRampedUp) {
    // 0.01 m/s apart: K v dt = 0.01 N per cycle, so 128 N are passed in cycle 12801; half a
    // cycle's margin against rounding of the sum of displacements.
    HeavyPair p(0.0, 0.5, 128.005f, 1e6f);
    p.discs().vx[1] = 0.01;
    int cycles = 0;
    while (p.bonded() && cycles < 20000) {
        p.cycle();
        ++cycles;
    }
    // The first cycle sees no stretch yet.
    EXPECT_EQ(cycles, 12802);
    const double v = p.discs().vx[1];
    p.cycle();
    EXPECT_EQ(p.discs().vx[1], v); // no force is left
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

TEST(BondBreak, ShearThatFrictionCannotCarry) {
    // Overlap 0.125 m: F_n = 128 N, mu F_n = 64 N; the bond holds 100 N. Arms are 2 m less the
    // overlap in sum, so the force grows by Ks dt * 1.875 = 0.9375 N per cycle: 106 cycles hold.
    HeavyPair p(0.125, 0.5, 1e6f, 100.0f);
    const std::vector<double> force = sheared(p, 150);
    for (std::size_t n = 0; n < 106; ++n)
        ASSERT_NEAR(force[n], 0.9375 * static_cast<double>(n + 1), 1e-9);
    for (std::size_t n = 106; n < 150; ++n)
        ASSERT_NEAR(force[n], 64.0, 1e-9);
    EXPECT_FALSE(p.bonded());
}

TEST(BondBreak, ShearThatFrictionCarriesOn) {
    // mu = 1: mu F_n = 128 N lies above the bond's 100 N, which the force passes without a step.
    HeavyPair p(0.125, 1.0, 1e6f, 100.0f);
    const std::vector<double> force = sheared(p, 150);
    for (std::size_t n = 0; n < 136; ++n)
        ASSERT_NEAR(force[n], 0.9375 * static_cast<double>(n + 1), 1e-9);
    for (std::size_t n = 136; n < 150; ++n)
        ASSERT_NEAR(force[n], 128.0, 1e-9);
    EXPECT_FALSE(p.bonded());
}

TEST(BondBreak, NoMomentInTheBond) {
    // Discs that roll on each other like gears feel nothing, bonded or not.
    HeavyPair p(0.125, 0.5, 1e6f, 1e-3f);
    p.discs().spin[0] = 1.0;
    p.discs().spin[1] = -1.0;
    for (int n = 0; n < 100; ++n)
        p.cycle();
    EXPECT_TRUE(p.bonded());
    EXPECT_NEAR(p.shear(), 0.0, 1e-12);
}

} // namespace
} // namespace listric
