// Throw against height (T-z) of growth faults made in a real packing, whose throw falls from 500 m
// in the basement to nothing five strata up.
//
// Tops of strata in 12 columns a side scatter by some 0.35 diameters about a plane: their two lines
// differ by 0.15, and the tilt of three tops brings another 0.2 to where the fault is. A diameter
// is some four times that.

#include "apps/measures/fault_throw.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace listric::fault_throw_test {

using namespace dem;
using namespace measures;
namespace {

using namespace support;

constexpr double radius = 93.1, d = 2.0 * radius, degree = pi / 180.0;
constexpr double base = -30.0 * d, tilt = 0.1, slip = 500.0;
constexpr int strata = 5; ///< that the fault offsets

const State& sample() {
    static const State made = settled(packing_request(110.0 * d, 40.0 * d, radius));
    return made;
}

/// A fault that falls right, or left as its mirror image, through strata that tilt.
struct GrowthFault {
    State state = sample();
    Polyline trace;

    GrowthFault(double dip, double thickness, double x, bool falls_right) {
        const DiscColumns c = disc_columns(state);
        const double side = falls_right ? 1.0 : -1.0, run = 1.0 / std::tan(dip * degree);
        for (std::size_t i = 0; i < c.x.size(); ++i) {
            const double height = c.y[i] - base, layers = std::max(0.0, height / thickness);
            c.stratum[i] = height < 0.0 ? 0 : static_cast<std::int32_t>(layers) + 1;
            c.start_y[i] = height;
            if (side * (c.x[i] - x) > -height * run)
                c.y[i] -= slip * std::max(0.0, 1.0 - layers / strata);
            c.y[i] += tilt * c.x[i];
        }
        for (int k = -10; k < 10; ++k)
            trace.push_back({x + side * 0.8 * d * k * std::cos(dip * degree),
                             base + tilt * x - 0.8 * d * k * std::sin(dip * degree)});
    }
};

TEST(GrowthFaults, ThrowByStratumIsExactToADiameter) {
    for (const double thickness : {3.2 * d, 4.0 * d, 6.0 * d})
        for (const double dip : {45.0, 60.0, 75.0})
            for (const double x : {50.0 * d, 63.0 * d})
                for (const bool falls_right : {true, false}) {
                    SCOPED_TRACE(testing::Message()
                                 << thickness / d << " " << dip << " " << x / d << falls_right);
                    const GrowthFault made(dip, thickness, x, falls_right);
                    const std::map<int, double> throws = fault_throws(made.state, made.trace, {});
                    EXPECT_GE(throws.size(), 3u);
                    for (const auto& [stratum, value] : throws)
                        EXPECT_NEAR(value, slip * std::max(0.0, 1.0 - stratum / 5.0), d) << stratum;
                }
}

// Between the cutoffs of strata in succession lies a stratum's thickness. Below the fault nothing
// moves: it is that laid down there; above it, the fault's growth is added. A thickness is the
// difference of two tops on one side, each known to 0.35 diameters.
TEST(GrowthFaults, CutoffsTellThicknessOnBothSides) {
    for (const double thickness : {4.0 * d, 6.0 * d})
        for (const bool falls_right : {true, false}) {
            const GrowthFault made(60.0, thickness, 55.0 * d, falls_right);
            const std::map<int, Cutoffs> cutoffs = fault_cutoffs(made.state, made.trace, {});
            int found = 0;
            for (const auto& [stratum, at] : cutoffs) {
                EXPECT_EQ(at.is_resolved, throws_of(cutoffs).contains(stratum));
                const auto below = cutoffs.find(stratum - 1);
                if (below == cutoffs.end() || stratum > strata)
                    continue;
                ++found;
                EXPECT_NEAR(at.footwall - below->second.footwall, thickness, d) << stratum;
                EXPECT_NEAR(at.hanging - below->second.hanging, thickness + slip / strata, d)
                    << stratum;
                EXPECT_DOUBLE_EQ(at.offset(), at.footwall - at.hanging);
            }
            EXPECT_GE(found, 3);
        }
}

} // namespace
} // namespace listric::fault_throw_test
