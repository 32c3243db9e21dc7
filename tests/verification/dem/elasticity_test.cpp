#include "apps/laboratory/compression.hpp"
#include "dem/contacts/contacts.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

namespace listric::elasticity_test {

using namespace dem;
namespace {

using namespace support;

/// Close-packed lattice between two platens, every contact bonded.
Specimen lattice(const Material& material, std::size_t columns) {
    constexpr double radius = 100.0;
    const std::size_t rows = 2 * columns + 7;
    Specimen s;
    s.state = make_state(hexagonal(columns, rows, radius), material);
    s.state.clock.time_step = stable_time_step(density * pi * radius * radius, material, 0.7, 0.65);
    const double top = radius * (2.0 + std::sqrt(3.0) * static_cast<double>(rows - 1));
    for (double& y : disc_columns(s.state).y)
        y += radius;
    s.base.surfaces = {{"bottom", {line({-1e6, 0.0}, {1e6, 0.0})}},
                       {"top", {line({1e6, top}, {-1e6, top})}}};
    s.base.material = material;
    s.base.motion = {1.0, 0.0};
    bond_all(s.state, s.base);
    return s;
}

// E = 2 sqrt(3) K (K + K_s) / (3 K + K_s) and nu = (K - K_s) / (3 K + K_s) of a hexagonal lattice
// with contact stiffnesses K and K_s. Free edges, whose discs have fewer neighbours, soften a
// sample by their share, which halves with twice as many columns.
TEST(Elasticity, UniaxialTestMeasuresTheHexagonalLattice) {
    for (double ratio : {1.0, 2.66}) {
        Material material;
        material.shear_stiffness = material.normal_stiffness / ratio;
        const double k = 0.5 * material.normal_stiffness, ks = k / ratio;
        const double young = 2.0 * std::sqrt(3.0) * k * (k + ks) / (3.0 * k + ks);
        const auto measure = [&](std::size_t columns) {
            return elasticity(compress_elastically(lattice(material, columns), {0.0, 1e-5}));
        };
        const Elasticity coarse = measure(10), fine = measure(20);
        EXPECT_NEAR(fine.young_2d / young, 1.0, 0.06) << ratio;
        EXPECT_LT(std::abs(fine.young_2d - young), 0.65 * std::abs(coarse.young_2d - young))
            << ratio;
        EXPECT_NEAR(fine.poisson_2d, (k - ks) / (3.0 * k + ks), 0.005) << ratio;
    }
}

} // namespace
} // namespace listric::elasticity_test
