// A bonded hexagonal lattice of discs is an isotropic elastic sheet. With the contact stiffnesses
// K and K_s, in two dimensions:
//   C11 = sqrt(3)/4 (3 K + K_s),  C12 = sqrt(3)/4 (K - K_s),  G = sqrt(3)/4 (K + K_s);
//   E = 2 sqrt(3) K (K + K_s) / (3 K + K_s),  nu = (K - K_s) / (3 K + K_s) under one stress.
// Stress is the sum of force times arm over a disc's area times the solid fraction pi / (2 sqrt 3).

#include "dem/contacts/monitor.hpp"
#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

namespace listric::lattice_modulus_test {

using namespace dem;
namespace {

using namespace support;

class LatticeModulus : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, LatticeModulus, every_cycle(), cycle_name);

constexpr double r = 93.1;
const double root = std::sqrt(3.0), solid_fraction = pi / (2.0 * root);
const Material material;
const double K = 0.5 * material.normal_stiffness, Ks = 0.5 * material.shear_stiffness;
const double C11 = 0.25 * root * (3.0 * K + Ks), C12 = 0.25 * root * (K - Ks),
             G = 0.25 * root * (K + Ks);

struct Gradient {
    double xx, xy, yx, yy; ///< of the displacement: xy = du_x/dy
};

/// Stress of a disc amid a lattice that is deformed homogeneously by the cycle: discs are too heavy
/// to feel forces and have the velocities of the deformation, their spin that of its rotation.
Stress stress_of(const Gradient& g, const Execution& execution) {
    constexpr int steps = 100;
    constexpr std::size_t columns = 15, rows = 11;
    State state = make_state(hexagonal(columns, rows, r), material);
    bond_all(state, {});
    state.inertial_mass_floor = 1e30;
    state.clock.time_step = 1e-3;
    const double rate = 1.0 / (steps * state.clock.time_step);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.vx[i] = rate * (g.xx * d.x[i] + g.xy * d.y[i]);
        d.vy[i] = rate * (g.yx * d.x[i] + g.yy * d.y[i]);
        d.spin[i] = rate * 0.5 * (g.yx - g.xy);
    }
    advance(state, {}, {0.0, 0.0}, steps, execution);
    const Stress s = disc_stresses(state, {})[columns * (rows / 2) + columns / 2];
    return {solid_fraction * s.xx, solid_fraction * s.yy, solid_fraction * s.xy};
}

TEST_P(LatticeModulus, OfHomogeneousStrain) {
    // Nonlinear by the strain itself, 1e-6; round-off of 1e-16 in places of 1e3 m is 1e-9 of the
    // overlaps of 1e-4 m.
    constexpr double strain = 1e-6;
    const double tolerance = 1e-5 * C11 * strain;
    const auto expect = [&](const Gradient& g, double xx, double yy, double xy) {
        const Stress s = stress_of(g, GetParam());
        EXPECT_NEAR(s.xx, xx * strain, tolerance);
        EXPECT_NEAR(s.yy, yy * strain, tolerance);
        EXPECT_NEAR(s.xy, xy * strain, tolerance);
    };
    expect({strain, 0.0, 0.0, 0.0}, C11, C12, 0.0);
    expect({0.0, 0.0, 0.0, strain}, C12, C11, 0.0);
    expect({0.0, strain, strain, 0.0}, 0.0, 0.0, 2.0 * G);
    expect({0.0, strain, 0.0, 0.0}, 0.0, 0.0, G);
    expect({0.0, -strain, strain, 0.0}, 0.0, 0.0, 0.0);
    EXPECT_NEAR(C11 - C12, 2.0 * G, 1e-12 * C11);
}

struct Elasticity {
    double modulus, ratio;
    double lateral_stress, unbalanced; ///< as shares of the stress and of the mean contact force
};

/// Moduli measured amid a specimen, three times as long as wide, that smooth platens compress
/// along the close-packed rows or across them and that has come to rest.
Elasticity compressed(bool along, const Execution& execution) {
    constexpr double shortening = 1e-6;
    constexpr std::size_t length = 41, width = 13;
    const std::size_t columns = along ? length : width, rows = along ? width : length;
    State state = make_state(hexagonal(columns, rows, r), material);
    const double left = -r, right = 2.0 * r * static_cast<double>(columns);
    const double low = -r, high = r * (1.0 + root * static_cast<double>(rows - 1));
    RigidBase base;
    if (along) {
        const double push = 0.5 * shortening * (right - left);
        base.surfaces = {{"left", {line({left + push, 2.0 * high}, {left + push, -high})}},
                         {"right", {line({right - push, -high}, {right - push, 2.0 * high})}}};
    } else {
        const double push = 0.5 * shortening * (high - low);
        base.surfaces = {{"low", {line({-right, low + push}, {2.0 * right, low + push})}},
                         {"high", {line({2.0 * right, high - push}, {-right, high - push})}}};
    }
    bond_all(state, base);
    const DiscColumns d = disc_columns(state);
    // Damping 0.7 takes a factor 1 / sqrt(1.7) from the limit, see time_step_limit_test.
    state.clock.time_step = stable_time_step(d.mass[0], material, 0.7, 0.9);
    advance(state, base, {0.7, 0.0}, 8000, execution);

    const auto disc = [&](std::size_t column, std::size_t row) { return columns * row + column; };
    const std::size_t column = columns / 2, row = rows / 2;
    // Over 12 discs along the load, over 4 across it.
    const std::size_t x = along ? 6 : 2, y = along ? 2 : 6;
    const auto strain = [](double start, double now) { return (now - start) / start; };
    const std::size_t a = disc(column - x, row), b = disc(column + x, row);
    const double xx = strain(d.start_x[b] - d.start_x[a], d.x[b] - d.x[a]);
    const std::size_t p = disc(column, row - y), q = disc(column, row + y);
    const double yy = strain(d.start_y[q] - d.start_y[p], d.y[q] - d.y[p]);
    const Stress stress = disc_stresses(state, base)[disc(column, row)];
    const double axial = solid_fraction * (along ? stress.xx : stress.yy);
    const double lateral = solid_fraction * (along ? stress.yy : stress.xx);
    return {along ? axial / xx : axial / yy, along ? -yy / xx : -xx / yy, lateral / axial,
            force_balance(state, base, 0.0).max_ratio()};
}

TEST_P(LatticeModulus, OfUniaxialStress) {
    // The platens press on single discs. That decays as exp(-4.2 x / width) (Saint-Venant), here to
    // 2e-3 in the middle, of an unevenness that is itself a tenth: 5e-4.
    const double E = 2.0 * root * K * (K + Ks) / (3.0 * K + Ks), nu = (K - Ks) / (3.0 * K + Ks);
    for (bool along : {true, false}) {
        const Elasticity e = compressed(along, GetParam());
        EXPECT_LT(e.unbalanced, 1e-6);
        EXPECT_NEAR(e.lateral_stress, 0.0, 5e-4) << along;
        EXPECT_NEAR(e.modulus, E, 5e-4 * E) << along;
        EXPECT_NEAR(e.ratio, nu, 5e-4) << along;
    }
}

} // namespace
} // namespace listric::lattice_modulus_test
