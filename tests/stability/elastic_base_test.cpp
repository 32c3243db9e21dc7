// Bases much softer and much stiffer than the discs on them, afloat on strong and on weak springs.

#include "tests/coupled_discs.hpp"
#include "tests/stability/hard_case.hpp"

#include <gtest/gtest.h>

namespace listric::elastic_base_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

struct HardBase {
    double softness, winkler;
    int interval;
    double mass_factor;
};

struct Rest {
    double greatest, displacement, drift; ///< m; the last over 100,000 cycles
    std::int64_t cycles;                  ///< until it hardly moved
};

/// Unloads a base and lets it swing until it hardly moves, or for 2 million cycles: the softer the
/// springs and the heavier the modes, the longer.
Rest come_to_rest(const HardBase& hard, CouplingParameters p) {
    p.interval = hard.interval;
    p.mass_factor = hard.mass_factor;
    Coupled coupled = settled(floating(hard.softness, hard.winkler), p);
    unload(coupled);
    Rest rest{};
    // A swing stands still where it turns: so the range of 100,000 cycles, not a difference.
    const auto go = [&] {
        double least = coupled.greatest_displacement(), most = least;
        for (int part = 0; part < 10; ++part) {
            coupled.go(10000);
            least = std::min(least, coupled.greatest_displacement());
            most = std::max(most, coupled.greatest_displacement());
        }
        rest.greatest = std::max(rest.greatest, most);
        rest.displacement = coupled.greatest_displacement();
        rest.drift = most - least;
    };
    do {
        go();
        rest.cycles += 100000;
    } while ((rest.drift > 0.05 || rest.displacement < 0.1) && rest.cycles < 2000000);
    go();
    EXPECT_EQ(coupled.state.discs.rows(), hanging_wall().discs.rows());
    std::printf("softness %g, springs %g, interval %d, mass %g: %.3g m after %lld cycles, then "
                "%.3g m per 100,000\n",
                hard.softness, hard.winkler, hard.interval, hard.mass_factor, rest.displacement,
                static_cast<long long>(rest.cycles), rest.drift);
    return rest;
}

class Footwall : public testing::TestWithParam<HardBase> {};

TEST_P(Footwall, ComesToRest) {
    const Rest rest = come_to_rest(GetParam(), {});
    EXPECT_LT(rest.greatest, 4.0);
    EXPECT_GT(rest.displacement, 0.1);
    EXPECT_LT(rest.drift, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Ratios, Footwall,
                         testing::Values(HardBase{1e-4, 1.0, 5, 0.6},   // 1e4 times as stiff
                                         HardBase{1e-2, 1.0, 5, 0.6},   //
                                         HardBase{1.0, 1.0, 1, 0.6},    //
                                         HardBase{1.0, 1.0, 5, 60.0},   // heavy
                                         HardBase{1.0, 0.03, 20, 0.6},  // weak springs
                                         HardBase{100.0, 1.0, 20, 0.6}, // 100 times as soft
                                         HardBase{100.0, 1.0, 1, 6.0},
                                         HardBase{100.0, 0.03, 5, 0.6},
                                         HardBase{100.0, 0.03, 20, 60.0}));

/// 10,000 cycles. A base that is 100 m away has left, though its numbers may still be finite.
void go_until_the_base_leaves(Coupled& coupled) {
    for (int part = 0; part < 20; ++part) {
        coupled.go(500);
        if (!(coupled.greatest_displacement() < 100.0))
            throw NumericalFailure("the base has left");
    }
}

TEST(FootwallUnstable, WandersOnWeakSpringsWithoutADashpot) {
    // The discs' damping leaves their mean motion alone, and the modes weigh little beside them.
    CouplingParameters p;
    const HardBase weak{1.0, 0.03, 20, 0.6};
    EXPECT_NEAR(come_to_rest(weak, p).displacement, 1.0, 0.02);
    p.swing_damping = 0.0;
    EXPECT_GT(std::abs(come_to_rest(weak, p).displacement - 1.0), 0.05);
}

TEST(FootwallUnstable, WithATenthOfTheMass) {
    // A tenth of a scene's least mass_factor, 0.6, shows its purpose.
    CouplingParameters p;
    p.mass_factor = 0.06;
    Coupled coupled = settled(floating(1.0, 1.0), p);
    unload(coupled);
    EXPECT_THROW(go_until_the_base_leaves(coupled), NumericalFailure);
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

} // namespace
} // namespace listric::elastic_base_test
