// Bases much softer and much stiffer than the discs on them, afloat on strong and on weak springs.

#include "tests/coupled_discs.hpp"
#include "tests/stability/hard_case.hpp"

#include <gtest/gtest.h>

namespace listric {
namespace {

using namespace support;

/// Length of the interface, m, and restoring stress of mantle below, Pa/m.
constexpr double afloat = 6e3, mantle = 3300.0 * gravity;

/// An elastic base that also floats, as one: its compliance over that of rock as stiff as the
/// discs' (50 GPa: 2e-11 m per N/m over a kilometre), and its springs over the mantle's.
Interface floating(double softness, double winkler) {
    Interface interface = make_interface(2e-11 * softness);
    const std::size_t n = interface.unknowns();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i % 2; k < n; k += 2)
            interface.compliance[i * n + k] += 1.0 / (mantle * winkler * afloat);
    return interface;
}

/// Takes from the reference load what moves the base by about a metre: strains stay small.
void unload(Coupled& coupled) {
    const auto load = coupled.state.base_nodes.get<double>("reference_load_y");
    std::vector<double> forces(2 * load.size(), 0.0);
    for (std::size_t k = 0; k < load.size(); ++k)
        forces[2 * k + 1] = load[k];
    double moves = 0.0;
    for (const double u : coupled.elastic.displacement(forces))
        moves = std::max(moves, std::abs(u));
    for (double& f : load)
        f *= 1.0 - std::min(0.1, 1.0 / moves);
}

struct HardBase {
    double softness, winkler;
    int interval;
    double mass_factor;
};

class Footwall : public testing::TestWithParam<HardBase> {};

TEST_P(Footwall, ComesToRest) {
    const auto [softness, winkler, interval, mass_factor] = GetParam();
    CouplingParameters p;
    p.interval = interval;
    p.mass_factor = mass_factor;
    Coupled coupled = settled(floating(softness, winkler), p);
    unload(coupled);
    // On weak springs discs swing for long if only what departs from their mean motion is damped.
    if (winkler < 1.0)
        coupled.physics.averaging_time = 0.0;
    // To rest, however slowly: the softer the springs and the heavier the modes, the longer.
    constexpr int part = 10000, most = 80;
    double greatest = 0.0, before = 0.0, drift = 0.0;
    int parts = 0;
    for (int quiet = 0; parts < most && quiet < 3; ++parts) {
        before = coupled.greatest_displacement();
        coupled.go(part);
        greatest = std::max(greatest, coupled.greatest_displacement());
        drift = std::abs(coupled.greatest_displacement() - before) / part * 1e5;
        quiet = drift < 0.05 && before > 0.1 ? quiet + 1 : 0;
    }
    before = coupled.greatest_displacement();
    coupled.go(2 * part);
    drift = std::abs(coupled.greatest_displacement() - before) / (2 * part) * 1e5;
    std::printf("softness %g, springs %g, interval %d, mass %g: %.3g m after %d cycles, then %.3g m "
                "per 100,000\n",
                softness, winkler, interval, mass_factor, before, parts * part, drift);
    EXPECT_LT(greatest, 4.0);
    EXPECT_GT(before, 0.1);
    EXPECT_LT(drift, 0.1);
    EXPECT_EQ(coupled.state.discs.rows(), hanging_wall().discs.rows());
}

INSTANTIATE_TEST_SUITE_P(Ratios, Footwall,
                         testing::Values(HardBase{1e-4, 1.0, 5, 0.6},   // 1e4 times as stiff
                                         HardBase{1e-2, 1.0, 5, 0.6},   //
                                         HardBase{1.0, 1.0, 1, 0.6},    //
                                         HardBase{1.0, 1.0, 5, 60.0},   // heavy
                                         HardBase{1.0, 0.03, 20, 0.6},  // weak springs
                                         HardBase{100.0, 1.0, 20, 0.6}, // 100 times as soft
                                         HardBase{100.0, 1.0, 1, 6.0},
                                         HardBase{100.0, 0.03, 5, 0.6}));

/// 10,000 cycles. A base that is 100 m away has left, though its numbers may still be finite.
void go_until_the_base_leaves(Coupled& coupled) {
    for (int part = 0; part < 20; ++part) {
        coupled.go(500);
        if (!(coupled.greatest_displacement() < 100.0))
            throw NumericalFailure("the base has left");
    }
}

TEST(FootwallUnstable, WithATenthOfTheMass) {
    // What the least mass_factor of a scene, 0.6, is for.
    CouplingParameters p;
    p.mass_factor = 0.06;
    Coupled coupled = settled(floating(1.0, 1.0), p);
    unload(coupled);
    EXPECT_THROW(go_until_the_base_leaves(coupled), NumericalFailure);
}

TEST(FootwallUnstable, StaggeredAsItsCheckPredicts) {
    for (const double softness : {1.0, 100.0}) {
        CouplingParameters p;
        p.scheme = CouplingScheme::staggered;
        Coupled coupled = settled(floating(softness, 1.0), p);
        EXPECT_GT(coupled.elastic.staggered_growth(), 1.0);
        unload(coupled);
        EXPECT_THROW(go_until_the_base_leaves(coupled), NumericalFailure) << softness;
    }
    // Rigid enough, held fast: the check is content, and rightly.
    CouplingParameters p;
    p.scheme = CouplingScheme::staggered;
    Coupled coupled = settled(make_interface(2e-14), p);
    EXPECT_LT(coupled.elastic.staggered_growth(), 1.0);
    unload(coupled);
    coupled.go(10000);
    EXPECT_LT(coupled.greatest_displacement(), 1.0);
}

TEST(Footwall, RestartsInTheMiddleOfABlow) {
    CouplingParameters p;
    p.interval = 20;
    p.modes = 30;
    Coupled whole = settled(floating(100.0, 0.03), p), parts = settled(floating(100.0, 0.03), p);
    for (Coupled* c : {&whole, &parts}) {
        unload(*c);
        c->base.motion = {1.0, 1.0};
    }
    whole.go(1500);
    parts.go(707); // between two updates
    parts.state = restarted(parts.state);
    parts.go(793);
    EXPECT_EQ(hash(parts.state), hash(whole.state));
    EXPECT_GT(whole.greatest_displacement(), 1e-3);
}

TEST(Strong, FindsThePlaceThatModalComesTo) {
    CouplingParameters iterated;
    iterated.scheme = CouplingScheme::strong;
    iterated.interval = 20;
    Coupled modal = settled(floating(1.0, 1.0)), strong = settled(floating(1.0, 1.0), iterated);
    for (Coupled* c : {&modal, &strong})
        unload(*c);
    modal.go(60000);
    const double computed = strong.elastic.advance_iterated(strong.state, strong.base,
                                                            strong.physics, 60000, {});
    std::printf("modal %.4f m, strong %.4f m, every interval computed %.1f times\n",
                modal.greatest_displacement(), strong.greatest_displacement(), computed);
    EXPECT_GT(strong.greatest_displacement(), 0.1);
    EXPECT_NEAR(strong.greatest_displacement() / modal.greatest_displacement(), 1.0, 0.03);
    EXPECT_LT(computed, 20.0);
}

} // namespace
} // namespace listric
