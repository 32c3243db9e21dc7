// Leapfrog is stable for dt below 2 / omega of the fastest mode.
//   chain: omega = 2 sqrt(K / m) cos(pi / (2 n)) with n discs and free ends; the limit is
//     sqrt(m / K), 1 + 1e-4 times that for n = 100. At 0.99 the amplitude stays below
//     1 / sqrt(1 - 0.99^2) = 7.1; at 1.01 it grows by 1.33 per step, 1e6 in 50 steps.
//   hexagonal lattice without shear stiffness: sqrt(2/3) sqrt(m / K) = 0.816, which is what
//     stable_time_step() gives for six contacts.
//   local damping a: in the fastest mode, whose velocity changes sign with every step, the damping
//     force always adds to the spring's. That is a spring of (1 + a) K: 1 / sqrt(1 + a) times the
//     undamped limit, 0.767 at a = 0.7.
//   inertial mass floor f: as if every lighter disc had the mass f, sqrt(f / m) times.
// Bonds are unbreakable and displacements tiny, so that the system stays linear.

#include "dem/cycle/cycle.hpp"
#include "tests/verification/every_cycle.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace listric::time_step_limit_test {

using namespace dem;
namespace {

using namespace support;

class TimeStepLimit : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, TimeStepLimit, every_cycle(), cycle_name);

constexpr double r = 93.1, amplitude = 1e-7;
const double mass = density * pi * r * r;

/// A lattice whose discs are displaced at random or, in a chain, in its fastest mode.
State displaced(const std::vector<Disc>& discs, const Material& material, double time_step) {
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
    return state;
}

/// Greatest displacement, in units of the initial one, after the given steps. Stops once it is
/// large.
double growth(const std::vector<Disc>& discs, const Material& material, double time_step, int steps,
              const Execution& execution, double damping = 0.0, double mass_floor = 0.0) {
    State state = displaced(discs, material, time_step);
    state.inertial_mass_floor = mass_floor;
    const DiscColumns d = disc_columns(state);
    double largest = 0.0;
    for (int n = 0; n < steps && largest < 1e4; n += 10) {
        advance(state, {}, {damping, 0.0}, 10, execution);
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

TEST_P(TimeStepLimit, OfTheDampedChain) {
    for (double a : {0.3, 0.7}) {
        const Material m;
        const double limit = unit(m) / std::sqrt(1.0 + a);
        EXPECT_LT(growth(row(100, r), m, 0.99 * limit, 10000, GetParam(), a), 7.2) << a;
        EXPECT_GT(growth(row(100, r), m, 1.01 * limit, 200, GetParam(), a), 1e4) << a;
    }
}

TEST_P(TimeStepLimit, RisesWithTheInertialMassFloor) {
    // Discs that weigh m and move as if they weighed 4 m: twice the limit.
    const Material m;
    const double limit = 2.0 * unit(m);
    EXPECT_LT(growth(row(100, r), m, 0.99 * limit, 10000, GetParam(), 0.0, 4.0 * mass), 7.2);
    EXPECT_GT(growth(row(100, r), m, 1.01 * limit, 100, GetParam(), 0.0, 4.0 * mass), 1e4);
}

// Fastest modes of the hexagonal lattice: omega^2 = (6 K + 2 K_s) / m of rows that shake against
// each other, 24 K_s / m of discs that all spin alike. Free edges slow them down; random motion of
// 20 x 20 discs still shows either within 1 %.

TEST_P(TimeStepLimit, OfTheHexagonalLatticeWithoutShearStiffness) {
    const Material m{1.7e11, 1e-3, 0.0, true};
    const std::vector<Disc> lattice = hexagonal(20, 20, r);
    const double limit = std::sqrt(2.0 / 3.0) * unit(m);
    EXPECT_NEAR(stable_time_step(mass, m, 0.0, 1.0), limit, 1e-12 * limit);
    EXPECT_LT(growth(lattice, m, 0.99 * limit, 3000, GetParam()), 100.0);
    EXPECT_GT(growth(lattice, m, 1.01 * limit, 1000, GetParam()), 1e4);
}

TEST_P(TimeStepLimit, OfTheHexagonalLattice) {
    const std::vector<Disc> lattice = hexagonal(20, 20, r);
    for (double ratio : {0.2, 0.375, 1.0})
        for (double a : {0.0, 0.7}) {
            const Material m{1.7e11, ratio * 1.7e11, 0.05, true};
            const double undamped =
                2.0 * unit(m) / std::sqrt(std::max(6.0 + 2.0 * ratio, 24.0 * ratio));
            const double limit = undamped / std::sqrt(1.0 + a);
            EXPECT_LT(growth(lattice, m, 0.99 * limit, 3000, GetParam(), a), 100.0)
                << "K_s / K = " << ratio << ", damping " << a;
            EXPECT_GT(growth(lattice, m, 1.01 * limit, 1000, GetParam(), a), 1e4)
                << "K_s / K = " << ratio << ", damping " << a;
            // Conservative by no more than a tenth.
            EXPECT_LE(stable_time_step(mass, m, a, 1.0), (1.0 + 1e-12) * limit);
            EXPECT_GE(stable_time_step(mass, m, a, 1.0), 0.9 * limit);
        }
}

TEST_P(TimeStepLimit, StableTimeStepIsBelowThatOfAPacking) {
    GenesisRequest request = packing_request(12e3, 10e3, 250.0);
    request.bonds = BondStrength{1e30, 0.0, 1e30, 0.0, StrengthReading::force};
    const State packing = [&] {
        State state = settled(request);
        advance(state, request.base, request.physics, 5000, GetParam());
        return state;
    }();
    for (double damping : {0.0, 0.7}) {
        State state = packing;
        state.clock.time_step *=
            std::sqrt((1.0 + request.physics.damping) / (1.0 + damping)) / request.time_step_safety;
        const DiscColumns d = disc_columns(state);
        Random random(8);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            d.vx[i] = 1e-3 * random.between(-1.0, 1.0);
            d.vy[i] = 1e-3 * random.between(-1.0, 1.0);
        }
        advance(state, request.base, {damping, request.physics.gravity}, 5000, GetParam());
        for (std::size_t i = 0; i < d.x.size(); ++i)
            ASSERT_LT(std::hypot(d.vx[i], d.vy[i]), 1e-2) << damping;
    }
}

TEST_P(TimeStepLimit, IsNoticedWhenExceeded) {
    // 1 % beyond it the guard stops a chain and a lattice before discs are more than some radii
    // from where they belong, and says which and where; the program's own step never troubles it.
    const Material m;
    const double of_chain = unit(m), of_lattice = 2.0 * unit(m) / std::sqrt(24.0 * 6.38 / 17.0);
    for (const auto& [discs, limit] :
         {std::pair(row(100, r), of_chain), std::pair(hexagonal(20, 20, r), of_lattice)}) {
        State state = displaced(discs, m, 1.01 * limit);
        try {
            advance(state, {}, {0.0, 0.0}, 5000, GetParam());
            FAIL() << "not noticed";
        } catch (const NumericalFailure& failure) {
            EXPECT_THAT(failure.what(),
                        testing::ContainsRegex("disc [0-9]+ .* x = .* y = .* cycle"));
        }
        const double own = stable_time_step(mass, m, 0.0, 1.0);
        EXPECT_LE(own, (1.0 + 1e-12) * limit);
        State stable = displaced(discs, m, 0.99 * own);
        EXPECT_NO_THROW(advance(stable, {}, {0.0, 0.0}, 5000, GetParam()));
    }
}

TEST(TimeStepLimit, ShrinksWithMassAndStiffness) {
    const Material m, stiff{4.0 * m.normal_stiffness, 4.0 * m.shear_stiffness, 0.0, true};
    const double step = stable_time_step(mass, m, 0.7, 0.8);
    EXPECT_DOUBLE_EQ(stable_time_step(4.0 * mass, m, 0.7, 0.8), 2.0 * step);
    EXPECT_DOUBLE_EQ(stable_time_step(mass, stiff, 0.7, 0.8), 0.5 * step);
    EXPECT_DOUBLE_EQ(stable_time_step(mass, m, 0.7, 0.4), 0.5 * step);
}

} // namespace
} // namespace listric::time_step_limit_test
