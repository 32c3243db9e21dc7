// Elastic plates of 0.5 and of 300 km under a line load, against the exact solution for an elastic
// layer that floats. The thin plate neglects shear: it is right for the thin one, whose bending
// length is six times its thickness, and off by a tenth and more for the thick one. In a scene with
// discs the base ends at depth_m, so that a thicker plate is refused.

#include "apps/model/effects.hpp"
#include "apps/support/error.hpp"
#include "fem/elastic_layer.hpp"
#include "fem/plate.hpp"
#include "tests/message_of.hpp"
#include "tests/verification/footwalls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace listric::fem_elastic_thickness_test {
namespace {

using namespace support;
using fem::Vector;
using testing::AllOf;
using testing::HasSubstr;

constexpr double line_load = 1e12, restoring = 3300.0 * standard_gravity;

fem::Plate thin_plate(double thickness) { return {70e9, 0.25, thickness, restoring}; }

/// Deflection below the load, by the theory of the layer.
double exact_below_load(double thickness) {
    const fem::ElasticLayer layer{70e9, 0.25, thickness, 0.0, restoring};
    return layer.deflection(std::vector{0.0}, 0.5 * thickness, [](double) { return line_load; })
        .front();
}

/// Largest difference between elements and layer, of the deflection below the load.
double error_of_elements(double thickness, int cells) {
    const double side = 10.0 * thin_plate(thickness).alpha(); // mirror images add e^-15
    fem::FootwallRequest request = layer(thickness, -side, side, thickness / cells);
    request.surface_breaks = {0.0};
    const auto footwall = fem::make_footwall(request);
    const fem::PointForce force{{0.0, 0.0}, {0.0, -line_load}};
    fem::Load load;
    load.interface = footwall->nodal_forces({&force, 1});
    footwall->solve(load);
    EXPECT_NEAR(footwall->reaction().y / line_load, 1.0, 1e-9);
    const fem::Field middle = row(footwall->field(), -0.5 * thickness, 1.0);
    std::vector<double> x, sunk;
    for (std::size_t k = 0; k < middle.place.size(); ++k)
        if (std::abs(middle.place[k].x) < 0.5 * side) {
            x.push_back(middle.place[k].x);
            sunk.push_back(-middle.displacement[k].y);
        }
    EXPECT_GT(x.size(), 10u);
    const fem::ElasticLayer theory{70e9, 0.25, thickness, 0.0, restoring};
    const std::vector<double> exact =
        theory.deflection(x, 0.5 * thickness, [](double) { return line_load; });
    double worst = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k)
        worst = std::max(worst, std::abs(sunk[k] - exact[k]));
    return worst / *std::ranges::max_element(exact);
}

TEST(ElasticThickness, HalfAKilometreAndThreeHundredBend) {
    // Fourth order. The force is singular, which is seen where the plate is as thick as it bends
    // long: four elements of the thick plate are off by 1.7e-3.
    EXPECT_LT(error_of_elements(500.0, 4), 1e-3);
    EXPECT_LT(error_of_elements(300e3, 8), 1e-3);
}

TEST(ElasticThickness, TheThinPlateIsRightForTheThinOneOnly) {
    const auto ratio = [](double thickness) {
        return thin_plate(thickness).line(0.0, line_load) / exact_below_load(thickness);
    };
    EXPECT_NEAR(ratio(500.0), 1.0, 0.02);
    EXPECT_LT(ratio(300e3), 0.9);
}

TEST(ElasticThickness, AboveTheBasesDepthIsRefused) {
    const auto refusal = [](const std::vector<std::string>& set) -> std::string {
        return support::message_of<SceneError>(
            [&] { load_scene({.scene = "lis1-elastic", .set = set, .accuracy = "draft"}); }, "");
    };
    EXPECT_THAT(refusal({"elastic_base.elastic_thickness_m=77e3"}),
                AllOf(HasSubstr("elastic_thickness_m"), HasSubstr("77000"), HasSubstr("30000"),
                      HasSubstr("raise depth_m")));
    EXPECT_EQ(refusal({"elastic_base.elastic_thickness_m=77e3", "elastic_base.depth_m=80e3"}), "");
    EXPECT_EQ(refusal({"elastic_base.elastic_thickness_m=500"}), "");
    EXPECT_THAT(refusal({"elastic_base.elastic_thickness_m=300e3"}),
                AllOf(HasSubstr("300000"), HasSubstr("at most 200000")));
}

} // namespace
} // namespace listric::fem_elastic_thickness_test
