// The overburden of the footwall's rock against a liquid of the same density that rests on it.

#include "coupling/water_load.hpp"
#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace listric::fem_prestress_test {

namespace {

using namespace support;
using fem::Vector;

constexpr double weight = 2700.0 * standard_gravity; // N/m^3

/// Load of a liquid up to y = 0 on the interface's nodes, from its trace as it is displaced, N.
std::vector<double> liquid_forces(const fem::Footwall& footwall, const std::vector<double>& u) {
    std::vector<double> x, y, ux, uy;
    for (std::size_t k = 0; k < footwall.interface().size(); ++k) {
        x.push_back(footwall.interface()[k].place.x);
        y.push_back(footwall.interface()[k].place.y);
        ux.push_back(u[2 * k]);
        uy.push_back(u[2 * k + 1]);
    }
    const double everywhere = 2.0 * x.back();
    return coupling::water_forces({x, y, ux, uy, 2}, 0.0, weight, everywhere);
}

/// Rock below a liquid of its own density does not feel that the detachment moves: it bends as if
/// nothing rested in springs there.
TEST(Prestress, IsBornByALiquidOfTheSameDensity) {
    fem::FootwallRequest request;
    request.base_spring = 600.0 * standard_gravity;
    request.surface_spring = weight;
    request.elastic_thickness = 10e3;
    request.skin_thickness = 3e3;
    request.cell_size = 2000.0;
    request.right_side = fem::Side::free; // so that all nodes of the detachment can move
    for (const auto& chain : {listric_detachment(), ramp_flat_ramp()}) {
        request.detachment = chain;
        request.detachment_spring = 0.0;
        fem::Load load;
        load.traction = [](Vector place, Vector, fem::Boundary boundary) {
            return Vector{0.0, boundary == fem::Boundary::base
                                   ? 5e6 * std::exp(-std::pow((place.x - 5e3) / 20e3, 2))
                                   : 0.0};
        };
        const auto bare = fem::make_footwall(request);
        bare->solve(load);
        const std::vector<double> u = bare->interface_displacement();

        request.detachment_spring = weight;
        const auto footwall = fem::make_footwall(request);
        std::vector<double> up = u, down = u;
        for (std::size_t i = 0; i < u.size(); ++i) {
            up[i] = 1e-3 * u[i]; // so small that the second order does not count
            down[i] = -1e-3 * u[i];
        }
        const std::vector<double> after = liquid_forces(*footwall, up);
        const std::vector<double> before = liquid_forces(*footwall, down);
        for (std::size_t i = 0; i < u.size(); ++i)
            load.interface.push_back((after[i] - before[i]) / 2e-3);
        footwall->solve(load);
        const std::vector<double> found = footwall->interface_displacement();
        double apart = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) {
            if (footwall->interface()[i / 2].place.x > 100e3)
                break; // further out the liquid ends
            apart = std::max(apart, std::abs(found[i] - u[i]));
            largest = std::max(largest, std::abs(u[i]));
        }
        std::printf("breakaway %.2f, %.2f m; apart by %.1e of %.1f m\n", u[0], u[1],
                    apart / largest, largest);
        EXPECT_LT(apart, 1e-4 * largest);
    }
}

/// Relaxed rock, 28 MPa, under 400 MPa: what turns under that weight gives way.
TEST(Prestress, IsTooMuchForRockThatIsTooSoft) {
    fem::FootwallRequest request;
    request.detachment = listric_detachment();
    request.surface_spring = request.detachment_spring = weight;
    request.base_spring = 600.0 * standard_gravity;
    request.elastic_thickness = 10e3;
    request.cell_size = 2000.0;
    request.interface_end = 60e3;
    const auto refusal = [&] {
        try {
            fem::make_footwall(request)->compliance();
        } catch (const fem::FootwallError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    request.relaxation = 1000.0;
    EXPECT_NE(refusal().find("is too soft to keep its shape"), std::string::npos);
    for (request.relaxation = 100.0; request.relaxation < 2e4; request.relaxation *= 10.0) {
        request.skin_thickness = 1e3;
        EXPECT_EQ(refusal(), "") << request.relaxation;
    }
}

} // namespace
} // namespace listric::fem_prestress_test
