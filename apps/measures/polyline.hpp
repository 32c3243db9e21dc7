#pragma once

#include "dem/numbers/point.hpp"

#include <cstddef>
#include <vector>

namespace listric::measures {

/// Points that a fault passes through, from its upper to its lower end, m.
using Polyline = std::vector<dem::Point>;

double length_of(const Polyline& points); ///< m

bool falls_right(const Polyline& points); ///< away from the breakaway

/// Whether the way from a down to b dips by less than 30 degrees.
bool is_low_angle(dem::Point a, dem::Point b);

/// Dip of the best straight line through the points, degrees in [0, 90].
double dip_of(const Polyline& points);

/// Curvature of the best parabola over the points' chord, 1/m; > 0: convex upward.
double curvature_of(const Polyline& points);

/// From some points before a point to as many behind it, fewer at the ends, m.
dem::Point chord_at(const Polyline& points, std::size_t k, std::size_t reach = 3);

/// Unit vector into the footwall: on the right of the downward direction where the fault falls
/// right.
dem::Point footwall_normal(const Polyline& points, std::size_t k);

/// Points one `spacing` apart, each the mean of its neighbourhood so that a grid does not show. At
/// least one point.
Polyline even(const Polyline& raw, double spacing);

/// Pieces between points where the line turns by more than 40 degrees within ten points.
std::vector<Polyline> without_kinks(const Polyline& points);

/// Distance from the polyline, m, and where the closest point is.
struct PolylinePlace {
    double distance = 0.0; ///< > 0 on the left of the polyline's direction
    bool beyond = false;   ///< the closest point is an end
};
PolylinePlace place_on(const Polyline& points, dem::Point p);

/// Whether a polyline passes between two points.
bool are_parted(dem::Point a, dem::Point b, const Polyline& by);

} // namespace listric::measures
