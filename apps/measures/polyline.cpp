#include "apps/measures/polyline.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace listric::measures {

using namespace dem;

double length_of(const Polyline& points) {
    double sum = 0.0;
    for (std::size_t k = 1; k < points.size(); ++k)
        sum += norm(points[k] - points[k - 1]);
    return sum;
}

bool falls_right(const Polyline& points) {
    assert(!points.empty());
    return points.back().x > points.front().x;
}

bool is_low_angle(Point a, Point b) { return a.y - b.y < 0.5 * norm(b - a); }

double dip_of(const Polyline& points) {
    assert(!points.empty());
    Point mean;
    for (Point p : points)
        mean = mean + p;
    mean = (1.0 / static_cast<double>(points.size())) * mean;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (Point p : points) {
        xx += (p.x - mean.x) * (p.x - mean.x);
        xy += (p.x - mean.x) * (p.y - mean.y);
        yy += (p.y - mean.y) * (p.y - mean.y);
    }
    return std::abs(0.5 * dem::arc_tangent(2.0 * xy, xx - yy)) * 180.0 / pi;
}

double curvature_of(const Polyline& points) {
    if (points.size() < 3)
        return 0.0;
    // Offset above the chord, taken to the right so that up is left, as a parabola.
    Point a = points.front(), b = points.back();
    if (b.x < a.x)
        std::swap(a, b);
    const Point t = unit(b - a);
    double sum[5] = {}, moment[3] = {};
    const double half = 0.5 * norm(b - a);
    for (Point p : points) {
        const double s = dot(p - a, t) / half - 1.0, w = cross(t, p - a);
        double power = 1.0;
        for (int k = 0; k < 5; ++k, power *= s) {
            sum[k] += power;
            if (k < 3)
                moment[k] += power * w;
        }
    }
    // Normal equations of w = c0 + c1 s + c2 s^2, by Cramer's rule.
    const auto determinant = [](double a0, double a1, double a2, double b0, double b1, double b2,
                                double c0, double c1, double c2) {
        return a0 * (b1 * c2 - b2 * c1) - a1 * (b0 * c2 - b2 * c0) + a2 * (b0 * c1 - b1 * c0);
    };
    const double all =
        determinant(sum[0], sum[1], sum[2], sum[1], sum[2], sum[3], sum[2], sum[3], sum[4]);
    const double c2 = determinant(sum[0], sum[1], moment[0], sum[1], sum[2], moment[1], sum[2],
                                  sum[3], moment[2]) /
                      all;
    return -2.0 * c2 / (half * half);
}

Point chord_at(const Polyline& points, std::size_t k, std::size_t reach) {
    assert(k < points.size());
    return points[std::min(k + reach, points.size() - 1)] - points[k > reach ? k - reach : 0];
}

Point footwall_normal(const Polyline& points, std::size_t k) {
    const Point chord = chord_at(points, k);
    const double length = norm(chord);
    const double side = falls_right(points) ? 1.0 : -1.0;
    return {side * chord.y / length, -side * chord.x / length};
}

Polyline even(const Polyline& raw, double spacing) {
    assert(!raw.empty() && spacing > 0.0);
    Polyline smooth(raw.size());
    for (std::size_t k = 0; k < raw.size(); ++k) {
        const std::size_t reach = std::min({std::size_t{5}, k, raw.size() - 1 - k});
        Point sum;
        for (std::size_t m = k - reach; m <= k + reach; ++m)
            sum = sum + raw[m];
        smooth[k] = (1.0 / static_cast<double>(2 * reach + 1)) * sum;
    }
    Polyline points{smooth.front()};
    double since = 0.0;
    for (std::size_t k = 1; k < smooth.size(); ++k) {
        Point from = smooth[k - 1];
        double left = norm(smooth[k] - from);
        while (since + left >= spacing) {
            from = from + ((spacing - since) / left) * (smooth[k] - from);
            points.push_back(from);
            left = norm(smooth[k] - from);
            since = 0.0;
        }
        since += left;
    }
    return points;
}

std::vector<Polyline> without_kinks(const Polyline& points) {
    const double sharpest = dem::cosine(40.0 * pi / 180.0);
    std::vector<Polyline> pieces;
    std::size_t begin = 0;
    const auto turn = [&](std::size_t k) {
        const std::size_t reach = std::min({std::size_t{10}, k, points.size() - 1 - k});
        if (reach < 3)
            return 1.0;
        return dot(unit(points[k] - points[k - reach]), unit(points[k + reach] - points[k]));
    };
    for (std::size_t k = 1; k + 1 < points.size(); ++k)
        if (turn(k) < sharpest && turn(k) <= turn(k - 1) && turn(k) < turn(k + 1)) {
            pieces.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                points.begin() + static_cast<std::ptrdiff_t>(k) + 1);
            begin = k;
        }
    pieces.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end());
    return pieces;
}

namespace {

/// Square of a point's distance from the straight line between two others, m²; NaN if they are one.
double square_distance(Point start, Point end, Point p) {
    const Point edge = end - start, off = p - start;
    const Point apart = off - std::clamp(dot(off, edge) / dot(edge, edge), 0.0, 1.0) * edge;
    return dot(apart, apart);
}

} // namespace

PolylinePlace place_on(const Polyline& points, Point p) {
    double least = 1e300;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
        least = std::min(least, square_distance(points[k], points[k + 1], p));
    least *= 1.0 + 1e-9; // Roots take longest: only of edges that may be the nearest.
    PolylinePlace best{1e300, true};
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        if (square_distance(points[k], points[k + 1], p) > least)
            continue;
        const Point edge = points[k + 1] - points[k], off = p - points[k];
        const double length = norm(edge);
        const double along = dot(off, edge) / length;
        const Point foot = points[k] + (std::clamp(along, 0.0, length) / length) * edge;
        if (const double distance = norm(p - foot); distance < std::abs(best.distance)) {
            best.distance = cross(edge, off) < 0.0 ? -distance : distance;
            best.beyond = (k == 0 && along < 0.0) || (k + 2 == points.size() && along > length);
        }
    }
    return best;
}

bool are_parted(Point a, Point b, const Polyline& by) {
    for (std::size_t k = 0; k + 1 < by.size(); ++k) {
        const Point from = by[k], edge = by[k + 1] - from, way = b - a;
        if ((cross(way, from - a) > 0.0) != (cross(way, by[k + 1] - a) > 0.0) &&
            (cross(edge, a - from) > 0.0) != (cross(edge, b - from) > 0.0))
            return true;
    }
    return false;
}

} // namespace listric::measures
