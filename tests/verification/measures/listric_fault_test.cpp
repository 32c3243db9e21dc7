// The listric fault of landscape models, against which their hanging wall is carried without
// strain: z(x) = -D (1 - exp(-x tan(dip) / D)) [Landlab, ListricKinematicExtender; Hobley et al.
// 2017]. The rock over it moves with the wall along x and down as the fault does, which is vertical
// shear.

#include "apps/measures/basin/kinematics.hpp"
#include "apps/measures/strata/predicted_horizons.hpp"
#include "apps/scene/picks/fault_fit.hpp"
#include "dem/numbers/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace listric::listric_fault_test {
namespace {

using namespace dem;
using namespace measures;

constexpr double soles_at = 10e3, dip = 60.0, extension = 500.0;

double fault(double x) {
    return -soles_at * (1.0 - std::exp(-x * std::tan(dip * pi / 180.0) / soles_at));
}

TEST(ListricFault, VerticalShearLeavesTheThicknessOfLandscapeModels) {
    constexpr double tolerance = 4.0; // of arcs and lines through the points, m
    std::vector<Point> points;
    for (double x = 0.0; x <= 30e3; x += 250.0)
        points.push_back({x, fault(x)});
    const FaultFit fit = fit_fault(points, tolerance);
    ASSERT_LT(fit.misfit, tolerance);
    DetachmentParameters detachment;
    detachment.start_dip = fit.start_dip;
    detachment.segments = fit.segments;
    const Chain chain = detachment_chain(detachment, 80e3);
    const auto top = inclined_shear_top(chain, extension, 0.0, 40e3);
    // Thickness of the hanging wall over the fault: 829.6 m at 1 km, as the documentation of
    // Landlab's component has it (830), and elsewhere that of the fault one extension nearer.
    EXPECT_NEAR(-fault(1e3 - extension), 829.6, 0.05);
    for (const double x : {1e3, 2e3, 5e3, 10e3, 20e3}) {
        const double at[] = {x};
        const double thickness = -depths_at(top, at)[0] - height_at(chain, x);
        std::printf("thickness at %g km: %.1f m\n", x / 1e3, thickness);
        EXPECT_NEAR(thickness, -fault(x - extension), 0.01 * 829.6) << x;
    }
}

} // namespace
} // namespace listric::listric_fault_test
