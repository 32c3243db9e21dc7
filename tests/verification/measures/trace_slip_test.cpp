// Slip of a fault between two rigid blocks, from points on regular grids and at random places: it
// is known exactly, whatever the points are.
//
// A gradient that is fitted to the neighbours within 1.9 spacings has up to two fifths too much on
// a grid, where rows of neighbours that the slip has moved come within reach or leave it. The slip
// is therefore the difference of displacements on both sides, exact but for the direction of the
// trace: 5 degrees off it make 0.4 %, and points that lie on the other side of a trace half a
// spacing off.

#include "apps/measures/faults/moved_points.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace listric::trace_slip_test {

using namespace dem;
using namespace measures;
namespace {

using namespace support;

constexpr double degree = pi / 180.0;
constexpr double wide = 160.0, high = 75.0; ///< spacings, of the section

/// The plane through the middle of the section that a block on its right slides down.
struct Made {
    double dip, slip; ///< degrees; spacings
    double spacing = 1.0;

    MovedPoints moved(const std::vector<Point>& places) const {
        const Point down{std::cos(dip * degree), -std::sin(dip * degree)};
        MovedPoints points;
        for (const Point p : places) {
            const bool moves = cross(down, p - Point{0.5 * wide, -0.5 * high}) > 0.0;
            points.x.push_back(spacing * p.x);
            points.y.push_back(spacing * p.y);
            points.dx.push_back(moves ? spacing * slip * down.x : 0.0);
            points.dy.push_back(moves ? spacing * slip * down.y : 0.0);
        }
        return points;
    }

    /// @param dip_error  of the trace, degrees
    void expect_found(const std::vector<Point>& places, double dip_error = 2.0) const {
        SCOPED_TRACE(testing::Message()
                     << "dip " << dip << " slip " << slip << " spacing " << spacing);
        const std::vector<TracedFault> faults = trace_faults(moved(places));
        ASSERT_FALSE(faults.empty());
        EXPECT_NEAR(faults[0].slip / spacing, slip, 0.05 * slip);
        EXPECT_NEAR(faults[0].dip, dip, dip_error);
        EXPECT_NEAR(faults[0].throw_down / spacing, slip * std::sin(dip * degree), 0.05 * slip);
        EXPECT_TRUE(faults[0].normal);
    }
};

/// A grid of two steps, turned by an angle, that fills the section.
std::vector<Point> grid(Point a, Point b, double angle) {
    const double c = std::cos(angle * degree), s = std::sin(angle * degree);
    std::vector<Point> places;
    for (int m = -400; m <= 400; ++m)
        for (int n = -400; n <= 400; ++n) {
            const Point q = m * a + n * b;
            const Point p{0.5 * wide + 0.31 + c * q.x - s * q.y,
                          -0.5 * high + 0.17 + s * q.x + c * q.y};
            if (p.x >= 0.0 && p.x <= wide && p.y <= 0.0 && p.y >= -high)
                places.push_back(p);
        }
    return places;
}

std::vector<Point> square(double angle) { return grid({1.0, 0.0}, {0.0, 1.0}, angle); }
std::vector<Point> hexagonal(double angle) {
    return grid({1.0, 0.0}, {0.5, 0.5 * std::sqrt(3.0)}, angle);
}

TEST(TraceSlip, OnGridsOfAnyKind) {
    Made{60.0, 2.0}.expect_found(square(0.0));
    Made{30.0, 1.0}.expect_found(square(0.0));
    Made{45.0, 2.0}.expect_found(square(0.0));
    Made{75.0, 0.5}.expect_found(square(0.0));
    Made{90.0, 1.5}.expect_found(square(0.0));
    Made{50.0, 3.0, 0.01}.expect_found(square(0.0));
    Made{60.0, 1.0}.expect_found(square(17.0));
    Made{35.0, 2.0, 250.0}.expect_found(square(45.0));
    Made{80.0, 0.7}.expect_found(square(30.0));
    Made{60.0, 2.0}.expect_found(hexagonal(0.0));
    Made{30.0, 0.6}.expect_found(hexagonal(0.0));
    Made{90.0, 1.0}.expect_found(hexagonal(0.0));
    Made{70.0, 2.5}.expect_found(hexagonal(23.0));
    Made{45.0, 1.0, 3.0}.expect_found(hexagonal(15.0));
    // Columns a fifth further apart than rows.
    Made{55.0, 1.5}.expect_found(grid({1.2, 0.0}, {0.0, 1.0}, 0.0));
}

// Where points are missing a trace wanders by a spacing or two, and so its dip by up to 7 degrees
// where it is short.
TEST(TraceSlip, AtRandomPlaces) {
    const double dips[] = {30.0, 37.0, 45.0, 52.0, 60.0, 67.0, 75.0, 82.0,
                           90.0, 40.0, 50.0, 60.0, 70.0, 80.0, 35.0};
    const double slips[] = {0.7, 1.0, 2.0, 3.0, 2.0, 1.0, 0.5, 1.5,
                            2.0, 1.5, 0.8, 1.0, 2.5, 1.2, 2.0};
    for (int k = 0; k < 15; ++k) {
        Random random(static_cast<std::uint64_t>(k) + 1);
        std::vector<Point> places;
        for (int n = 0; n < static_cast<int>(wide * high); ++n) {
            const double x = random.between(0.0, wide);
            places.push_back({x, random.between(-high, 0.0)});
        }
        Made{dips[k], slips[k], k % 2 == 0 ? 1.0 : 40.0}.expect_found(places, 8.0);
    }
}

} // namespace
} // namespace listric::trace_slip_test
