// The fit of trishear on folds made with known parameters.

#include "apps/model/effects/base_motion/trishear.hpp"
#include "dem/numbers/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::effects::base_motion::trishear_test {
namespace {

using dem::Point;

constexpr double degree = dem::pi / 180.0;

std::vector<MarkerTop> fold(const Trishear& shear, const SlippedFault& fault, double rough = 0.0) {
    std::vector<MarkerTop> tops;
    for (const double share : {0.2, 0.4, 0.6, 0.8}) {
        MarkerTop top{-share * fault.height, {}};
        for (int k = -50; k <= 50; ++k) {
            Point p = carried({fault.foot.x + 0.04 * fault.height * k, top.level}, shear, fault);
            p.y += rough * std::sin(12.9898 * k + 78.233 * share); // no more than that
            top.points.push_back(p);
        }
        tops.push_back(top);
    }
    return tops;
}

TEST(Trishear, RecoversWhatAFoldWasMadeWith) {
    for (const double slip : {600.0, -600.0})
        for (const double dip : {45.0, 70.0})
            for (const double propagation : {1.5, 3.0})
                for (const double angle : {50.0, 80.0}) {
                    const SlippedFault fault{{12e3, -4e3}, dip * degree, slip, 4e3};
                    const Trishear made{angle * degree, propagation};
                    const auto found = fit_trishear(fold(made, fault, 10.0), fault);
                    ASSERT_TRUE(found);
                    // Tops that are 10 m rough (7.1 m root mean square), of a throw of 420 to 560
                    // m; found: within 0.8 degrees and 0.1.
                    EXPECT_NEAR(found->apical_angle / degree, angle, 1.5);
                    EXPECT_NEAR(found->propagation, propagation, 0.15);
                    EXPECT_LT(found->misfit, 8.0);
                }
}

TEST(Trishear, KeepsAreaAndLeavesTheFootwall) {
    const SlippedFault fault{{0.0, -4e3}, 60.0 * degree, -500.0, 4e3};
    const Trishear shear{60.0 * degree, 2.0};
    const Point still = carried({-9e3, -1e3}, shear, fault),
                moves = carried({9e3, -1e3}, shear, fault);
    EXPECT_NEAR(still.x, -9e3, 1e-6);
    EXPECT_NEAR(still.y, -1e3, 1e-6);
    EXPECT_NEAR(moves.x, 9e3 - 500.0 * std::cos(60.0 * degree), 1e-6);
    EXPECT_NEAR(moves.y, -1e3 + 500.0 * std::sin(60.0 * degree), 1e-6);
    // A small square in the triangle keeps its area to what steps of the slip make.
    const double h = 1.0;
    const auto at = [&](double x, double y) {
        return carried({-1200.0 + x, -1500.0 + y}, shear, fault);
    };
    const Point a = at(0, 0), b = at(h, 0), c = at(0, h);
    EXPECT_NEAR((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 1.0, 0.01);
}

TEST(Trishear, NeedsPointsAndSlip) {
    const SlippedFault fault{{0.0, -4e3}, 60.0 * degree, 500.0, 4e3};
    EXPECT_FALSE(fit_trishear({}, fault));
    EXPECT_FALSE(
        fit_trishear(fold({}, {{0.0, -4e3}, 1.0, 0.0, 4e3}), {{0.0, -4e3}, 1.0, 0.0, 4e3}));
}

} // namespace
} // namespace listric::effects::base_motion::trishear_test
