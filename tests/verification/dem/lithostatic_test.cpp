// In a settled packing between frictionless walls the vertical stress is the weight above,
//   sigma_v = rho g z,
// and K_0 = sigma_h / sigma_v is a property of the packing (recorded).
// Stress is measured from contact forces, sigma_ij = sum F_i l_j / area, branches cut at the bins'
// edges, so that a bin averages the force through all its horizontal sections. Bins are 24
// diameters wide and 3 high: the mass above a section scatters by about a hundredth of two layers'
// mass, 1 % at the shallowest bin: 2 %. The side walls carry the thrust rho g K_0 depth^2 / 2;
// sigma_h differs by a tenth between layers, their mean by 5 %. Floor and walls balance the weight
// and each other to what is left of the motion, 1e-6.

#include "dem/contacts/monitor.hpp"
#include "dem/law.hpp"
#include "tests/verification/every_cycle.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::lithostatic_test {

using namespace dem;
namespace {

using namespace support;

class Lithostatic : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Lithostatic, every_cycle(), cycle_name);

constexpr double length = 12e3, depth = 10e3;
constexpr int bins = 5;
constexpr double top = -1e3, height = 1.6e3;

struct BinStress {
    double vertical = 0.0, horizontal = 0.0; ///< Pa, compression positive
};

/// Mean stresses of layers from `top` down.
std::vector<BinStress> bin_stresses(const State& state) {
    std::vector<BinStress> stress(bins);
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const double stiffness = contact_stiffness(state.materials[basement]);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        const double distance = std::hypot(dx, dy);
        const double overlap = d.radius[i] + d.radius[j] - distance;
        if (overlap <= 0.0)
            continue;
        const double fx = (stiffness * overlap * dx - c.shear_force[k] * dy) / distance;
        const double fy = (stiffness * overlap * dy + c.shear_force[k] * dx) / distance;
        const double low = std::min(d.y[i], d.y[j]), up = std::max(d.y[i], d.y[j]);
        for (int b = 0; b < bins; ++b) {
            const double bin_up = top - b * height, bin_low = bin_up - height;
            const double inside = std::min(up, bin_up) - std::max(low, bin_low);
            if (inside <= 0.0)
                continue;
            const double share = inside / (up - low) / (length * height);
            stress[static_cast<std::size_t>(b)].vertical += share * fy * dy;
            stress[static_cast<std::size_t>(b)].horizontal += share * fx * dx;
        }
    }
    return stress;
}

TEST_P(Lithostatic, StressIsTheWeightAbove) {
    const GenesisRequest request = packing_request(length, depth, 250.0);
    State state = settled(request);
    advance(state, request.base, request.physics, 10000, GetParam());
    const ForceBalance balance = force_balance(state, request.base, request.physics.gravity);
    EXPECT_NEAR(balance.reaction[0].y, balance.weight, 1e-6 * balance.weight);
    EXPECT_NEAR(balance.reaction[1].x, -balance.reaction[2].x, 1e-6 * balance.weight);

    double vertical = 0.0, horizontal = 0.0;
    const std::vector<BinStress> stress = bin_stresses(state);
    for (int b = 0; b < bins; ++b) {
        const BinStress& s = stress[static_cast<std::size_t>(b)];
        const double expected = 2600.0 * request.physics.gravity * -(top - (b + 0.5) * height);
        EXPECT_NEAR(s.vertical, expected, 0.02 * expected) << "bin " << b;
        vertical += s.vertical;
        horizontal += s.horizontal;
    }
    const double K0 = horizontal / vertical;
    RecordProperty("K0", std::to_string(K0));
    const double thrust = 0.5 * K0 * 2600.0 * request.physics.gravity * depth * depth;
    EXPECT_NEAR(balance.reaction[1].x, thrust, 0.05 * thrust);
}

} // namespace
} // namespace listric::lithostatic_test
