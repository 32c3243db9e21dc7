// Knots of loads on the footwall's surface: two at least, since a load between none has no width.

#include "coupling/footwall_erosion.hpp"

#include <gtest/gtest.h>

namespace listric::coupling {
namespace {

TEST(SurfaceKnots, ReachTheEndOrTwoKilometresFromIt) {
    for (const double left : {-1.0, -1500.0, -2000.0, -2001.0, -30e3, -200e3}) {
        const std::vector<double> knots = surface_knots(60e3, left);
        const double end = std::max(left, -60e3);
        ASSERT_GE(knots.size(), 2u) << left;
        EXPECT_EQ(knots.back(), 0.0);
        EXPECT_GE(knots.front(), end);
        EXPECT_LE(knots.front(), end + 2e3);
    }
}

} // namespace
} // namespace listric::coupling
