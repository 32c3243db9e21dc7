// Faults in points that no disc made. The truth is a plane through the origin that slips by three
// spacings; a strain fit sees the points beside it, so its trace must lie within half a spacing of
// the plane in the mean and within two at its ends, where the section ends, and the throw within a
// quarter of what the points on both sides show.

#include "apps/measures/faults/moved_points.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv.hpp"
#include "tests/message_of.hpp"
#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace listric::measures::moved_points_test {

using namespace dem;
namespace {

constexpr double spacing = 10.0;

/// A grid of 81 by 41 points at rest, moved off their places by up to a fifth of the spacing.
MovedPoints section() {
    MovedPoints points;
    support::Random random(7);
    for (int i = -40; i <= 40; ++i)
        for (int j = -40; j <= 0; ++j) {
            points.x.push_back(spacing * (i + random.between(-0.2, 0.2)));
            points.y.push_back(spacing * (j + random.between(-0.2, 0.2)));
        }
    points.dx.assign(points.x.size(), 0.0);
    points.dy.assign(points.x.size(), 0.0);
    return points;
}

TEST(MovedPoints, SpacingIsThatOfNeighbours) {
    EXPECT_NEAR(spacing_of(section()), spacing, 0.1 * spacing);
}

TEST(MovedPoints, PointsOnALineOrOnEachOtherHaveNoFaults) {
    MovedPoints points;
    for (int i = 0; i < 100; ++i) {
        points.x.push_back(spacing * i);
        points.y.push_back(-500.0);
        points.dx.push_back(i > 50 ? 20.0 : 0.0);
        points.dy.push_back(0.0);
    }
    EXPECT_NEAR(spacing_of(points), 1.5 * spacing, 0.1 * spacing); // two neighbours, and two beyond
    for (int turn = 0; turn < 2; ++turn) {
        EXPECT_EQ(objection_to(points), "");
        EXPECT_TRUE(trace_faults(points).empty());
        std::swap(points.x, points.y);
    }
    for (const double shift : {0.0, 1e-12, 1e-3}) { // all at one place, but one
        points.x.assign(100, 7.0);
        points.y.assign(100, -7.0);
        points.x.front() += shift;
        EXPECT_EQ(objection_to(points), "");
        EXPECT_TRUE(trace_faults(points).empty());
    }
}

TEST(MovedPoints, PointsFarFromAllOthersAreRefused) {
    for (const double far : {1e7, 1e18, 1e300, 1.7e308})
        for (int column = 0; column < 4; ++column) {
            MovedPoints points = section();
            for (std::size_t row : {3u, 4u}) { // one on either side
                std::vector<double>* const columns[] = {&points.x, &points.y, &points.dx,
                                                        &points.dy};
                (*columns[column])[row] = row == 3 ? far : -far;
            }
            if (far > 1e9) {
                EXPECT_NE(objection_to(points), "") << far << ' ' << column;
            } else if (objection_to(points).empty()) {
                EXPECT_NO_THROW(trace_faults(points));
            }
        }
    MovedPoints points = section();
    points.x.front() = points.y.front() = 1e8;
    EXPECT_THAT(objection_to(points), testing::HasSubstr("leave out those that are far"));
}

TEST(MovedPoints, AFaultIsTracedToWithinASpacing) {
    for (const double dip : {50.0, 60.0, 70.0, 120.0}) {
        const double angle = dip * std::numbers::pi / 180.0;
        const Point down{std::cos(angle), -std::sin(angle)};
        MovedPoints points = section();
        for (std::size_t i = 0; i < points.x.size(); ++i)
            if ((cross(down, {points.x[i], points.y[i]}) > 0.0) == (dip < 90.0)) {
                points.dx[i] = 3.0 * spacing * down.x;
                points.dy[i] = 3.0 * spacing * down.y;
            }
        const std::vector<TracedFault> faults = trace_faults(points);
        ASSERT_EQ(faults.size(), 1u) << dip;
        const TracedFault& fault = faults[0];
        EXPECT_NEAR(fault.dip, std::min(dip, 180.0 - dip), 3.0) << dip;
        EXPECT_TRUE(fault.normal) << dip;
        const double throw_down = -3.0 * spacing * down.y;
        EXPECT_NEAR(fault.throw_down, throw_down, 0.25 * throw_down) << dip;
        double sum = 0.0;
        for (const Point& at : fault.trace.points) {
            sum += std::abs(cross(down, at));
            EXPECT_LT(std::abs(cross(down, at)), 2.0 * spacing) << dip;
        }
        EXPECT_LT(sum, 0.5 * spacing * static_cast<double>(fault.trace.points.size())) << dip;
    }
}

TEST(MovedPoints, NeitherRotationNorEvenShearIsAFault) {
    for (const double spin : {0.0, 0.3}) {
        MovedPoints points = section();
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            points.dx[i] = 0.1 * points.y[i] - spin * points.y[i];
            points.dy[i] = spin * points.x[i];
        }
        EXPECT_TRUE(trace_faults(points).empty()) << spin;
    }
}

TEST(MovedPoints, AFileThatIsNoneIsRefusedByLineAndColumn) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "points.csv";
    const auto refusal = [&](const char* text) -> std::string {
        std::ofstream(file) << text;
        return support::message_of<SceneError>(
            [&] {
                read_csv(file, {.numbers = {"x_m", "depth_m"}});
            },
            "");
    };
    EXPECT_EQ(refusal("x_m,depth_m\n1,2\n"), "");
    EXPECT_THAT(refusal("x_m,depht_m\n1,2\n"), testing::HasSubstr("no column depth_m"));
    EXPECT_THAT(refusal("x_m,depth_m\n1,2\n1,two\n"), testing::HasSubstr("points.csv:3"));
    EXPECT_THAT(refusal("x_m,depth_m\n1\n"), testing::HasSubstr("points.csv:2"));
    std::filesystem::remove(file);
}

} // namespace
} // namespace listric::measures::moved_points_test
