// The contact law's rules, one contact and one cycle at a time:
//   F_n = K U;  F_s -= K_s dt v_s;  bonded while -F_n <= T_n and |F_s| <= T_s, without slip;
//   a tensile break removes both forces, a shear break leaves what friction carries, mu F_n;
//   no tension without a bond.
// Stiffnesses and strengths are powers of two, so that forces are exact and so are comparisons.

#include "dem/law.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace listric::law_test {

using namespace dem;
namespace {

constexpr ContactParameters parameters{1024.0f, 16.0f, 0.5f}; // K, K_s dt, mu
constexpr float tensile = 64.0f, shear_strength = 256.0f;
constexpr double tiny = 1e-12;

struct Outcome {
    double normal, shear;
    bool bonded;
};

Outcome contact(double overlap, double slip_rate, double shear_before, bool bonded_before) {
    double shear = shear_before;
    std::uint8_t bonded = bonded_before;
    const double normal =
        contact_force(overlap, slip_rate, parameters, tensile, shear_strength, shear, bonded);
    return {normal, shear, bonded == 1};
}

TEST(Law, SpringsInSeries) {
    const Material a{3.0e9, 1.0e9, 0.3, true}, b{6.0e9, 1.0e9, 0.1, true};
    const ContactParameters p = contact_parameters(a, b, 0.25);
    EXPECT_FLOAT_EQ(p.normal_stiffness, 2.0e9f);
    EXPECT_FLOAT_EQ(p.shear_stiffness_times_step, 0.125e9f);
    EXPECT_FLOAT_EQ(p.friction, 0.1f);
}

TEST(Law, ASpringWithoutStiffnessInSeriesGivesNone) {
    const Material smooth{3.0e9, 0.0, 0.3, true}, rough{3.0e9, 1.0e9, 0.3, true};
    EXPECT_EQ(contact_parameters(smooth, smooth, 0.25).shear_stiffness_times_step, 0.0f);
    EXPECT_EQ(contact_parameters(smooth, rough, 0.25).shear_stiffness_times_step, 0.0f);
    EXPECT_FLOAT_EQ(contact_parameters(smooth, rough, 0.25).normal_stiffness, 1.5e9f);
}

TEST(Law, RollingResistsUpToItsFriction) {
    Material a{4.0, 4.0, 0.5, true}, b = a;
    a.rolling_friction = 0.25;
    b.rolling_friction = 0.75;
    EXPECT_EQ(contact_parameters(a, b, 1.0).rolling_friction, 0.25f); // the smaller
    EXPECT_EQ(contact_parameters(b, b, 1.0).rolling_friction, 0.5f);  // no more than friction
    EXPECT_EQ(contact_parameters(a, Material{}, 1.0).rolling_friction, 0.0f);
    const ContactParameters p{1024.0f, 16.0f, 0.5f, 0.25f};
    EXPECT_EQ(rolling_moment(3.0, 0.5, 2.0, 128.0, p), 3.0 - 16.0 * 4.0 * 0.5);
    EXPECT_EQ(rolling_moment(3.0, -9.0, 2.0, 128.0, p), 0.25 * 2.0 * 128.0);
    EXPECT_EQ(rolling_moment(3.0, 9.0, 2.0, 128.0, p), -0.25 * 2.0 * 128.0);
    EXPECT_EQ(rolling_moment(3.0, 0.5, 2.0, 0.0, p), 0.0); // apart or bonded
}

TEST(Law, CompressionAndShearAreElastic) {
    const Outcome o = contact(0.25, -0.5, 3.0, false);
    EXPECT_EQ(o.normal, 256.0);
    EXPECT_EQ(o.shear, 11.0);
}

TEST(Law, GapWithoutBondGivesNothing) {
    for (double overlap : {-0.01, 0.0}) {
        const Outcome o = contact(overlap, 2.0, 100.0, false);
        EXPECT_EQ(o.normal, 0.0);
        EXPECT_EQ(o.shear, 0.0);
        EXPECT_FALSE(o.bonded);
    }
}

TEST(Law, BondTransmitsTensionAcrossAGap) {
    const Outcome o = contact(-0.03125, 0.5, 20.0, true);
    EXPECT_TRUE(o.bonded);
    EXPECT_EQ(o.normal, -32.0);
    EXPECT_EQ(o.shear, 12.0);
}

TEST(Law, TensileStrengthIsExact) {
    const double at_strength = tensile / 1024.0;
    const Outcome held = contact(-at_strength, 0.0, 50.0, true);
    EXPECT_TRUE(held.bonded);
    EXPECT_EQ(held.normal, -tensile);
    EXPECT_EQ(held.shear, 50.0);
    EXPECT_TRUE(contact(-at_strength * (1.0 - tiny), 0.0, 50.0, true).bonded);
    const Outcome broken = contact(-at_strength * (1.0 + tiny), 0.0, 50.0, true);
    EXPECT_FALSE(broken.bonded);
    EXPECT_EQ(broken.normal, 0.0);
    EXPECT_EQ(broken.shear, 0.0);
}

TEST(Law, NoSlipWhileBonded) {
    // mu F_n = 0.5 * 16 = 8, yet the bond holds up to 256.
    const Outcome o = contact(1.0 / 64.0, 0.0, shear_strength, true);
    EXPECT_TRUE(o.bonded);
    EXPECT_EQ(o.shear, shear_strength);
    // Under tension too.
    EXPECT_EQ(contact(-1.0 / 64.0, 0.0, -shear_strength, true).shear, -shear_strength);
}

TEST(Law, ShearStrengthIsExactInBothDirections) {
    for (double sign : {-1.0, 1.0}) {
        EXPECT_TRUE(contact(0.25, 0.0, sign * shear_strength * (1.0 - tiny), true).bonded);
        EXPECT_FALSE(contact(0.25, 0.0, sign * shear_strength * (1.0 + tiny), true).bonded);
    }
}

TEST(Law, ShearBreakLeavesWhatFrictionCarries) {
    const double shear = shear_strength + 4.0;
    for (double sign : {-1.0, 1.0}) {
        // mu F_n = 128 < F_s: clipped.
        const Outcome clipped = contact(0.25, 0.0, sign * shear, true);
        EXPECT_FALSE(clipped.bonded);
        EXPECT_EQ(clipped.normal, 256.0);
        EXPECT_EQ(clipped.shear, sign * 128.0);
        // mu F_n = 512 > F_s: unchanged.
        const Outcome carried = contact(1.0, 0.0, sign * shear, true);
        EXPECT_FALSE(carried.bonded);
        EXPECT_EQ(carried.normal, 1024.0);
        EXPECT_EQ(carried.shear, sign * shear);
    }
}

TEST(Law, ShearBreakUnderTensionLeavesNothing) {
    const Outcome o = contact(-1.0 / 64.0, 0.0, shear_strength + 4.0, true);
    EXPECT_FALSE(o.bonded);
    EXPECT_EQ(o.normal, 0.0);
    EXPECT_EQ(o.shear, 0.0);
}

TEST(Law, CoulombLimit) {
    EXPECT_EQ(contact(0.25, 0.0, 127.0, false).shear, 127.0);
    EXPECT_EQ(contact(0.25, 0.0, 129.0, false).shear, 128.0);
    EXPECT_EQ(contact(0.25, 0.0, -129.0, false).shear, -128.0);
    // Slip the other way unloads at once: the spring does not remember how far it slipped.
    EXPECT_EQ(contact(0.25, 1.0, 128.0, false).shear, 112.0);
}

TEST(Law, BrokenBondsStayBroken) {
    double shear = 0.0;
    std::uint8_t bonded = 1;
    contact_force(-1.0, 0.0, parameters, tensile, shear_strength, shear, bonded);
    ASSERT_EQ(bonded, 0);
    EXPECT_EQ(contact_force(-0.01, 0.0, parameters, tensile, shear_strength, shear, bonded), 0.0);
    EXPECT_EQ(contact_force(0.25, 0.0, parameters, tensile, shear_strength, shear, bonded), 256.0);
    EXPECT_EQ(bonded, 0);
}

} // namespace
} // namespace listric::law_test
