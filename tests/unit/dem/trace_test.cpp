// The wall of a base that deforms: closest points, corners, ends, shape functions.

#include "dem/base/place.hpp"
#include "dem/base/trace.hpp"
#include "dem/numbers/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace listric::trace_test {

using namespace dem;
namespace {

/// Nodes on a quarter circle from the vertical breakaway and on the flat behind it.
struct Wall {
    std::vector<double> x, y, ux, uy;
    int degree;

    Wall(double radius, std::size_t faces_on_arc, int degree_of_faces) : degree(degree_of_faces) {
        const std::size_t nodes = faces_on_arc * static_cast<std::size_t>(degree);
        const double step = 0.5 * pi * radius / static_cast<double>(nodes);
        for (std::size_t k = 0; k <= nodes; ++k) {
            const double angle = 0.5 * pi * static_cast<double>(k) / static_cast<double>(nodes);
            x.push_back(radius * (1.0 - std::cos(angle)));
            y.push_back(-radius * std::sin(angle));
        }
        for (std::size_t k = 1; k <= nodes; ++k) {
            x.push_back(radius + step * static_cast<double>(k));
            y.push_back(-radius);
        }
        ux.assign(x.size(), 0.0);
        uy.assign(x.size(), 0.0);
    }

    /// Smoothly, as elements bend: at kinks of a few degrees a point has two feet.
    void deform(double amplitude) {
        for (std::size_t k = 0; k < x.size(); ++k) {
            ux[k] = amplitude * std::sin(0.008 * y[k]);
            uy[k] = amplitude * std::cos(0.005 * x[k]);
        }
    }

    Trace trace() const { return {x, y, ux, uy, degree}; }
};

/// Nearest of many points of the wall.
double least_distance(const Trace& trace, Point p) {
    double least = 1e300;
    const std::size_t pieces = 2000 * trace.faces();
    for (std::size_t k = 0; k <= pieces; ++k) {
        const Point q = trace.at(static_cast<double>(k) / 2000.0);
        least = std::min(least, std::hypot(q.x - p.x, q.y - p.y));
    }
    return least;
}

TEST(Trace, FindsTheNearestPointOfADeformedWall) {
    for (const int degree : {1, 2}) {
        Wall wall(1000.0, 12, degree);
        wall.deform(10.0);
        const Trace trace = wall.trace();
        for (const double place : {0.3, 2.1, 5.5, 9.9, 11.9, 12.1, 17.25, 22.9})
            for (const double distance : {5.0, 60.0}) {
                const Point on = trace.at(place), ahead = trace.at(place + 1e-6);
                const double length = std::hypot(ahead.x - on.x, ahead.y - on.y);
                const Point p{on.x - distance * (ahead.y - on.y) / length,
                              on.y + distance * (ahead.x - on.x) / length};
                const auto found = trace.nearest(p);
                ASSERT_TRUE(found) << place;
                // The sampled distance exceeds the true one by (half a sample)^2 / (2 distance).
                EXPECT_NEAR(found->foot.distance, least_distance(trace, p), 1e-3)
                    << degree << " " << place << " " << distance;
                const Point q = trace.at(found->place);
                EXPECT_NEAR(q.x + found->foot.distance * found->foot.normal.x, p.x, 1e-9);
                EXPECT_NEAR(q.y + found->foot.distance * found->foot.normal.y, p.y, 1e-9);
                EXPECT_GT(found->foot.distance, 0.0);
                // From where it was before, moved by what a disc moves in a cycle: the foot is the
                // same to second order of what is left of 1e-4 faces after one step of Newton's.
                for (const double shift : {-1e-4, 1e-4}) {
                    const auto again = trace.nearest(p, found->place + shift);
                    ASSERT_TRUE(again);
                    EXPECT_NEAR(again->foot.distance, found->foot.distance, 1e-9);
                    EXPECT_NEAR(again->place, found->place, 1e-6);
                }
            }
    }
}

TEST(Trace, ApproachesTheArcWithTheThirdPowerOfTheFaces) {
    const double radius = 15000.0;
    std::vector<double> errors;
    for (const std::size_t faces : {6, 12, 24}) {
        const Wall wall(radius, faces, 2);
        double worst = 0.0;
        for (double angle = 0.05; angle < 1.5; angle += 0.01) {
            const double r = radius - 200.0;
            const Point p{radius - r * std::cos(angle), -r * std::sin(angle)};
            worst = std::max(worst, std::abs(wall.trace().nearest(p)->foot.distance - 200.0));
        }
        errors.push_back(worst);
    }
    // A parabola through three evenly spaced points of a circle: the fourth power of their spacing,
    // since the third-order term is a shift along the arc.
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4.0, 0.3);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 4.0, 0.3);
}

TEST(Trace, WeightsReproducePointAndSumToOne) {
    for (const int degree : {1, 2}) {
        Wall wall(1000.0, 6, degree);
        wall.deform(30.0);
        const auto found = wall.trace().nearest({400.0, -500.0});
        ASSERT_TRUE(found);
        double sum = 0.0, x = 0.0, y = 0.0;
        for (std::size_t k = 0; k <= static_cast<std::size_t>(degree); ++k) {
            sum += found->weight[k];
            x += found->weight[k] * wall.trace().node(found->node + k).x;
            y += found->weight[k] * wall.trace().node(found->node + k).y;
        }
        const Point q = wall.trace().at(found->place);
        EXPECT_NEAR(sum, 1.0, 1e-15);
        EXPECT_NEAR(x, q.x, 1e-10);
        EXPECT_NEAR(y, q.y, 1e-10);
    }
}

TEST(Trace, EndsWhereItEndsAndLeavesNoGapBelowTheBackstop) {
    Wall wall(1000.0, 12, 2);
    const Trace trace = wall.trace();
    EXPECT_FALSE(trace.nearest({50.0, 30.0}));                   // above the breakaway
    EXPECT_FALSE(trace.nearest({wall.x.back() + 20.0, -950.0})); // beyond the last node
    // Tilted away from the discs: just below the breakaway the foot is the breakaway itself.
    for (std::size_t k = 0; k < wall.x.size(); ++k)
        wall.ux[k] = 0.1 * wall.y[k];
    const auto corner = trace.nearest({50.0, -1.0});
    ASSERT_TRUE(corner);
    EXPECT_EQ(corner->place, 0.0);
    EXPECT_NEAR(corner->foot.distance, std::hypot(50.0, 1.0), 1e-12);
}

TEST(Trace, StandsAsChainWhereItIs) {
    Wall wall(1000.0, 12, 2);
    wall.deform(10.0);
    State state = empty_state();
    add_base_nodes(state, wall.x, wall.y);
    const BaseNodeColumns nodes = base_node_columns(state);
    std::ranges::copy(wall.ux, nodes.ux.begin());
    std::ranges::copy(wall.uy, nodes.uy.begin());
    RigidBase base;
    base.surfaces = {{"detachment", {line({0.0, 0.0}, {0.0, -1.0})}},
                     {"backstop", {line({0.0, 1e5}, {0.0, 0.0})}}};
    base.surfaces[0].follows = Follows::nodes;
    base.surfaces[1].follows = Follows::breakaway;
    const RigidBase standing = standing_base(base, state);
    for (const Point p : {Point{300.0, -600.0}, Point{900.0, -900.0}, Point{1500.0, -950.0}})
        // Chords of half faces: sagitta (65 m)^2 / (8 * 1000 m).
        EXPECT_NEAR(nearest(standing.surfaces[0], 0.0, p)->distance,
                    nearest(base.surfaces[0], base_place(state), p)->distance, 1.0);
    EXPECT_EQ(standing.surfaces[1].chain.back().end, wall.trace().node(0));
    EXPECT_EQ(nearest(standing.surfaces[1], 0.0, {100.0, 50.0})->distance,
              nearest(base.surfaces[1], base_place(state), {100.0, 50.0})->distance);
}

} // namespace
} // namespace listric::trace_test
