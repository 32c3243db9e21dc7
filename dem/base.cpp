#include "dem/base.hpp"

#include <cmath>

namespace listric {

namespace {

double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point left_normal(Point tangent) { return {-tangent.y, tangent.x}; }

Point centre(const Segment& s) {
    const Point n = left_normal(s.start_tangent);
    const double radius = 1.0 / s.curvature;
    return {s.start.x + n.x * radius, s.start.y + n.y * radius};
}

/// Foot point if it lies on the segment itself.
std::optional<Foot> foot_on(const Segment& s, Point p) {
    if (dot(p - s.start, s.start_tangent) < 0.0 || dot(p - s.end, s.end_tangent) > 0.0)
        return std::nullopt;
    if (s.curvature == 0.0) {
        const Point n = left_normal(s.start_tangent);
        return Foot{dot(p - s.start, n), dot(p - s.start, s.start_tangent), n};
    }
    const Point c = centre(s);
    const Point from_centre = p - c;
    const double r = std::sqrt(dot(from_centre, from_centre));
    if (r == 0.0)
        return std::nullopt;
    const double radius = std::abs(1.0 / s.curvature);
    const double side = s.curvature > 0.0 ? 1.0 : -1.0;
    const Point start = s.start - c;
    const double turned = std::atan2(side * cross(start, from_centre), dot(start, from_centre));
    // The two half-planes above hold for points opposite the arc as well.
    if (turned < -1e-9 || turned * radius > s.length * (1.0 + 1e-9))
        return std::nullopt;
    return Foot{side * (radius - r), turned * radius,
                {-side * from_centre.x / r, -side * from_centre.y / r}};
}

} // namespace

Segment line(Point start, Point end) {
    const double length = std::hypot(end.x - start.x, end.y - start.y);
    const Point t{(end.x - start.x) / length, (end.y - start.y) / length};
    return {start, end, t, t, length, 0.0};
}

Segment arc(Point start, Point tangent, double radius, double turn) {
    const double side = turn > 0.0 ? 1.0 : -1.0;
    const Point n = left_normal(tangent);
    const Point c{start.x + side * radius * n.x, start.y + side * radius * n.y};
    const double cosine = std::cos(turn), sine = std::sin(turn);
    const Point from_centre = start - c;
    return {start,
            {c.x + cosine * from_centre.x - sine * from_centre.y,
             c.y + sine * from_centre.x + cosine * from_centre.y},
            tangent,
            {cosine * tangent.x - sine * tangent.y, sine * tangent.x + cosine * tangent.y},
            radius * std::abs(turn),
            side / radius};
}

std::optional<Foot> foot_point(const Chain& chain, Point p) {
    std::optional<Foot> best;
    double before = 0.0;
    for (std::size_t k = 0; k < chain.size(); ++k) {
        const Segment& s = chain[k];
        if (auto foot = foot_on(s, p)) {
            foot->arc_length += before;
            if (!best || std::abs(foot->distance) < std::abs(best->distance))
                best = foot;
        }
        before += s.length;
        if (k + 1 == chain.size())
            break;
        // A corner that points into the material is a foot of its own.
        const Point out = p - s.end;
        if (dot(out, s.end_tangent) > 0.0 && dot(out, chain[k + 1].start_tangent) < 0.0) {
            const double distance = std::sqrt(dot(out, out));
            if (distance > 0.0 && (!best || distance < std::abs(best->distance)))
                best = Foot{distance, before, {out.x / distance, out.y / distance}};
        }
    }
    return best;
}

Point point_at(const Chain& chain, double arc_length) {
    for (std::size_t k = 0; k < chain.size(); ++k) {
        const Segment& s = chain[k];
        if (arc_length > s.length && k + 1 < chain.size()) {
            arc_length -= s.length;
            continue;
        }
        if (s.curvature == 0.0)
            return {s.start.x + arc_length * s.start_tangent.x,
                    s.start.y + arc_length * s.start_tangent.y};
        const Point c = centre(s);
        const double turn = arc_length * s.curvature;
        const double cosine = std::cos(turn), sine = std::sin(turn);
        const Point from_centre = s.start - c;
        return {c.x + cosine * from_centre.x - sine * from_centre.y,
                c.y + sine * from_centre.x + cosine * from_centre.y};
    }
    return {};
}

} // namespace listric
