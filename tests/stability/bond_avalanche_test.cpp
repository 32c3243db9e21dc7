// A stretched block in which one bond breaks, and then all: what the bonds held becomes motion.
// Expected: no disc gets more than the energy that was stored, momentum stays zero, nothing is
// lost.
//   Stored: K u^2 / 2 per bond stretched by u.
// The remedy against creation of energy is the time step; without it, 1.2 times the limit, motion
// exceeds what was stored.

#include "tests/stability/hard_case.hpp"

namespace listric::bond_avalanche_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1;

struct Block {
    State state;
    double stored = 0.0; ///< J
    std::int64_t bonds;

    explicit Block(double safety) {
        constexpr double strain = 1e-3;
        std::vector<Disc> discs = hexagonal(14, 14, r);
        for (Disc& disc : discs) {
            disc.x *= 1.0 + strain;
            disc.y *= 1.0 + strain;
        }
        state = make_state(discs);
        const double stretch = 2.0 * r * strain;
        const double K = contact_stiffness(state.materials[basement]);
        // All bonds just hold, and one does not.
        const auto strength = static_cast<float>(1.0005 * K * stretch);
        find_contacts(state, {});
        const ConstDiscColumns d = disc_columns(std::as_const(state));
        const ContactColumns c = contact_columns(state);
        for (std::size_t k = 0; k < c.first.size(); ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            if (std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i]) < 2.01 * r)
                bond(state, k, strength, strength);
        }
        bonds = count();
        stored = 0.5 * K * stretch * stretch * static_cast<double>(bonds);
        c.tensile_strength[c.first.size() / 2] *= 0.99f;
        state.clock.time_step = stable_time_step(d.mass[0], state.materials[basement], 0.0, safety);
    }

    std::int64_t count() const {
        return std::ranges::count(contact_columns(state).bonded, std::uint8_t{1});
    }

    double kinetic() const {
        const ConstDiscColumns d = disc_columns(state);
        double sum = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            sum += 0.5 * d.mass[i] *
                   (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i] +
                    0.5 * d.radius[i] * d.radius[i] * d.spin[i] * d.spin[i]);
        return sum;
    }
};

TEST(BondAvalanche, TurnsNoMoreThanWhatWasStoredIntoMotion) {
    Block block(0.95);
    double most = 0.0;
    for (int n = 0; n < 40; ++n) {
        advance_with_restart(block.state, {}, {0.0, 0.0}, 50);
        most = std::max(most, block.kinetic());
    }
    EXPECT_LT(block.count(), 7 * block.bonds / 10);
    EXPECT_LT(most, block.stored);
    EXPECT_GT(most, 0.1 * block.stored);
    const ConstDiscColumns d = disc_columns(std::as_const(block.state));
    double x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        x += d.mass[i] * d.vx[i];
        y += d.mass[i] * d.vy[i];
    }
    const double unit = std::sqrt(2.0 * most * total_mass(block.state));
    EXPECT_NEAR(x, 0.0, 1e-11 * unit);
    EXPECT_NEAR(y, 0.0, 1e-11 * unit);
}

TEST(BondAvalanche, CreatesEnergyBeyondTheLimitOfTheStep) {
    Block block(1.2);
    double most = 0.0;
    for (int n = 0; n < 40; ++n) {
        advance(block.state, {}, {0.0, 0.0}, 50);
        most = std::max(most, block.kinetic());
    }
    EXPECT_GT(most, block.stored);
}

} // namespace
} // namespace listric::bond_avalanche_test
