// Differential density scaling gives light discs a greater inertia, not a greater weight: the
// inertial mass appears in m dv/dt only. Equilibrium under gravity does not know it,
//   sum F + m g = 0 of every disc, and the floor carries sum m g.
// Its reward, a stable step that rises as the root of the mass, is in time_step_limit_test.

#include "dem/contacts/monitor.hpp"
#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::weight_test {

using namespace dem;
namespace {

using namespace support;

class Weight : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Weight, every_cycle(), cycle_name);

constexpr double r = 93.1;
constexpr CyclePhysics physics{0.7, 9.81};

/// Settles a state with a floor for inertial masses, in steps that the lightest inertia allows.
void settle(State& state, const RigidBase& base, double mass_floor, const Execution& execution) {
    const double lightest = *std::ranges::min_element(disc_columns(state).mass);
    state.inertial_mass_floor = mass_floor;
    state.clock.time_step =
        stable_time_step(std::max(lightest, mass_floor), state.materials[basement], 0.7, 0.9);
    find_contacts(state, base);
    advance(state, base, physics, 20000, execution);
}

TEST_P(Weight, OfAStack) {
    // Discs of different sizes on top of each other: the contact below the n-th carries what it and
    // all above it weigh, to the single precision of the stiffness, 6e-8; the floor to what is left
    // of the motion.
    const RigidBase base = box(4.0 * r, 1e4);
    const std::vector<double> radii{r, 0.3 * r, 0.8 * r, 0.2 * r, 0.5 * r, 0.25 * r};
    std::vector<Disc> discs;
    double y = 0.0;
    for (double radius : radii) {
        discs.push_back({2.0 * r, y + radius, radius});
        y += 2.0 * radius;
    }
    for (double floor : {0.0, 0.5, 4.0}) {
        State state = make_state(discs, base.material);
        settle(state, base, floor * density * pi * r * r, GetParam());
        const ConstDiscColumns d = disc_columns(std::as_const(state));
        const double K = contact_stiffness(base.material);
        const ForceBalance balance = force_balance(state, base, physics.gravity);
        double above = 0.0;
        for (std::size_t i = radii.size() - 1; i > 0; --i) {
            above += d.mass[i] * physics.gravity;
            const double overlap = radii[i] + radii[i - 1] - (d.y[i] - d.y[i - 1]);
            EXPECT_NEAR(K * overlap, above, 1e-7 * above) << "floor " << floor << ", disc " << i;
        }
        EXPECT_NEAR(balance.reaction[1].y, balance.weight, 1e-9 * balance.weight);
    }
}

TEST_P(Weight, OfABlock) {
    // A bonded block of discs of unequal density between smooth walls: with and without the mass
    // floor it settles to the same contact forces. Both are at rest to 1e-9; the shear force is
    // summed up while contacts turn and so depends on the way there, but by far less than the
    // strain, 1e-4: 1e-5.
    const RigidBase base = box(25.0 * r, 1e4);
    std::vector<Disc> discs = hexagonal(12, 12, r);
    const auto forces = [&](double floor) {
        State state = make_state(discs, base.material);
        const DiscColumns d = disc_columns(state);
        Random random(3);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            d.x[i] += r;
            d.y[i] += r;
            d.mass[i] *= random.between(0.1, 1.0);
        }
        bond_all(state, base);
        settle(state, base, floor * density * pi * r * r, GetParam());
        const ForceBalance balance = force_balance(state, base, physics.gravity);
        EXPECT_LT(balance.max_ratio(), 1e-9);
        EXPECT_NEAR(balance.reaction[1].y, balance.weight, 1e-9 * balance.weight);
        std::vector<double> result;
        const ConstContactColumns c = contact_columns(std::as_const(state));
        for (std::size_t k = 0; k < c.first.size(); ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            result.push_back(contact_stiffness(base.material) *
                             (2.0 * r - std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i])));
            result.push_back(c.shear_force[k]);
        }
        return result;
    };
    const std::vector<double> real = forces(0.0), scaled = forces(0.9);
    ASSERT_EQ(real.size(), scaled.size());
    const double greatest = *std::ranges::max_element(real);
    for (std::size_t k = 0; k < real.size(); ++k)
        EXPECT_NEAR(scaled[k], real[k], 1e-5 * greatest) << k;
}

} // namespace
} // namespace listric::weight_test
