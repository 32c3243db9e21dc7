// Leapfrog is stable for dt below 2 / omega of the fastest mode.
//   chain: omega = 2 sqrt(K / m) cos(pi / (2 n)) with n discs and free ends; the limit is
//     sqrt(m / K), 1 + 1e-4 times that for n = 100. At 0.99 the amplitude stays below
//     1 / sqrt(1 - 0.99^2) = 7.1; at 1.01 it grows by 1.33 per step, 1e6 in 50 steps.
//   hexagonal lattice without shear stiffness: sqrt(2/3) sqrt(m / K) = 0.816, which is what
//     stable_time_step() gives for six contacts.
// Bonds are unbreakable and displacements tiny, so that the system stays linear.

#include "dem/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric {
namespace {

using namespace support;

class TimeStepLimit : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, TimeStepLimit, every_cycle(), cycle_name);

constexpr double r = 93.1, amplitude = 1e-7;
const double mass = density * pi * r * r;

/// Greatest displacement, in units of the initial one, after the given steps of a lattice whose
/// discs are displaced at random or, in a chain, in its fastest mode. Stops once it is large.
double growth(std::vector<Disc> discs, const Material& material, double time_step, int steps,
              const Execution& execution) {
    State state = make_state(discs, material);
    bond_all(state, {});
    state.clock.time_step = time_step;
    const DiscColumns d = disc_columns(state);
    const bool chain = discs.back().y == 0.0;
    Random random(6);
    const auto n_discs = static_cast<double>(discs.size());
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double phase = pi * (n_discs - 1.0) / n_discs * (static_cast<double>(i) + 0.5);
        d.x[i] += amplitude * (chain ? std::cos(phase) : random.between(-1.0, 1.0));
        d.y[i] += chain ? 0.0 : amplitude * random.between(-1.0, 1.0);
        d.spin[i] = chain ? 0.0 : 0.1 * amplitude / (r * time_step);
    }
    double largest = 0.0;
    for (int n = 0; n < steps && largest < 1e4; n += 10) {
        advance(state, {}, {0.0, 0.0}, 10, execution);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            largest = std::max({largest, std::abs(d.x[i] - discs[i].x) / amplitude,
                                std::abs(d.y[i] - discs[i].y) / amplitude,
                                std::abs(d.spin[i]) * r * time_step / amplitude});
    }
    return largest;
}

double unit(const Material& m) { return std::sqrt(mass / contact_stiffness(m)); }

TEST_P(TimeStepLimit, OfTheChain) {
    const Material m;
    EXPECT_LT(growth(row(100, r), m, 0.99 * unit(m), 10000, GetParam()), 7.2);
    EXPECT_GT(growth(row(100, r), m, 1.01 * unit(m), 100, GetParam()), 1e4);
}

TEST_P(TimeStepLimit, OfTheHexagonalLatticeWithoutShearStiffness) {
    const Material m{1.7e11, 1e-3, 0.0, true};
    const std::vector<Disc> lattice = hexagonal(20, 20, r);
    const double limit = std::sqrt(2.0 / 3.0) * unit(m);
    EXPECT_NEAR(stable_time_step(mass, m, 1.0), limit, 1e-12 * limit);
    EXPECT_LT(growth(lattice, m, 0.99 * limit, 3000, GetParam()), 100.0);
    EXPECT_GT(growth(lattice, m, 1.03 * limit, 1000, GetParam()), 1e4);
}

TEST_P(TimeStepLimit, StableTimeStepIsBelowIt) {
    // Table 1's stiffnesses in the most connected packing, with the default safety.
    const Material m;
    EXPECT_LT(growth(hexagonal(20, 20, r), m, stable_time_step(mass, m, 0.8), 5000, GetParam()),
              100.0);
}

TEST_P(TimeStepLimit, StableTimeStepNeedsNoSafety) {
    // Fastest modes of the lattice: omega^2 = 6 (K + K_s) / m of discs that shake, 24 K_s / m of
    // discs that all spin alike. The second is the higher one from K_s = K / 3.
    for (double ratio : {0.2, 0.375, 0.7, 1.0}) {
        const Material m{1.7e11, ratio * 1.7e11, 0.05, true};
        EXPECT_LT(
            growth(hexagonal(20, 20, r), m, stable_time_step(mass, m, 0.98), 3000, GetParam()),
            100.0)
            << "K_s / K = " << ratio;
    }
}

TEST(TimeStepLimit, ShrinksWithMassAndStiffness) {
    const Material m, stiff{4.0 * m.normal_stiffness, 4.0 * m.shear_stiffness, 0.0, true};
    const double step = stable_time_step(mass, m, 0.8);
    EXPECT_DOUBLE_EQ(stable_time_step(4.0 * mass, m, 0.8), 2.0 * step);
    EXPECT_DOUBLE_EQ(stable_time_step(mass, stiff, 0.8), 0.5 * step);
    EXPECT_DOUBLE_EQ(stable_time_step(mass, m, 0.4), 0.5 * step);
}

} // namespace
} // namespace listric
