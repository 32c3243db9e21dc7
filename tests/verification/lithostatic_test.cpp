// In a settled packing between frictionless walls the vertical stress is the weight above, rho g z.
// It is measured from contact forces, sigma = sum F_y l_y / area, branches cut at the bins' edges,
// so that a bin averages the force through all its horizontal sections. Bins are 24 diameters wide
// and 3 high: the mass above a section scatters by about a hundredth of two layers' mass, 1 % at
// the shallowest bin, and genesis leaves the weight 1 % out of balance: 3 %.

#include "dem/genesis.hpp"
#include "dem/law.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric {
namespace {

using namespace support;

constexpr double length = 12e3, depth = 10e3, g = 9.81;

TEST(Lithostatic, StressIsTheWeightAbove) {
    GenesisRequest r;
    r.hanging_wall.length = length;
    r.hanging_wall.thickness = depth;
    r.hanging_wall.mean_radius = 250.0;
    constexpr double high = 1e5;
    r.base.surfaces = {{"floor", {line({0.0, -depth}, {length, -depth})}},
                       {"left", {line({0.0, high}, {0.0, -depth})}},
                       {"right", {line({length, -depth}, {length, high})}}};
    r.materials = {Material{}, Material{}, Material{}};
    r.physics = {0.7, g};
    const State state = make_hanging_wall(r, [](std::string_view, double) {});

    constexpr int bins = 5;
    constexpr double top = -1e3, height = 1.6e3;
    std::vector<double> stress(bins, 0.0);
    // Adds a vertical force that is transmitted between two heights.
    const auto transmit = [&](double low, double up, double force) {
        for (int b = 0; b < bins; ++b) {
            const double bin_up = top - b * height, bin_low = bin_up - height;
            const double inside = std::min(up, bin_up) - std::max(low, bin_low);
            if (inside > 0.0)
                stress[static_cast<std::size_t>(b)] += force * inside / (length * height);
        }
    };
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const double stiffness = contact_stiffness(state.materials[basement]);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        auto i = static_cast<std::size_t>(c.first[k]), j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        const double distance = std::hypot(dx, dy);
        const double overlap = d.radius[i] + d.radius[j] - distance;
        if (overlap <= 0.0)
            continue;
        // Upward force on j of what lies below it, if j is the upper disc.
        const double fy = (stiffness * overlap * dy + c.shear_force[k] * dx) / distance;
        transmit(std::min(d.y[i], d.y[j]), std::max(d.y[i], d.y[j]), dy > 0.0 ? fy : -fy);
    }
    for (int b = 0; b < bins; ++b) {
        const double expected = 2600.0 * g * -(top - (b + 0.5) * height);
        EXPECT_NEAR(stress[static_cast<std::size_t>(b)], expected, 0.03 * expected) << "bin " << b;
    }
}

} // namespace
} // namespace listric
