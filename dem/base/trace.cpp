#include "dem/base/trace.hpp"

#include <algorithm>
#include <cmath>

namespace listric::dem {

std::array<double, 3> shape_functions(int degree, double t) {
    if (degree == 1)
        return {1.0 - t, t, 0.0};
    return {(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)};
}

Trace::Face Trace::face(std::size_t k) const {
    const Point a = node(degree_ * k);
    if (degree_ == 1) {
        const Point end = node(k + 1);
        return {a, {end.x - a.x, end.y - a.y}, {0.0, 0.0}};
    }
    const Point middle = node(2 * k + 1), end = node(2 * k + 2);
    return {a,
            {4.0 * middle.x - 3.0 * a.x - end.x, 4.0 * middle.y - 3.0 * a.y - end.y},
            {2.0 * (a.x + end.x) - 4.0 * middle.x, 2.0 * (a.y + end.y) - 4.0 * middle.y}};
}

/// Last face whose start p has passed, by the tangent there. A detachment never rises, so along it
/// the answer changes once, and so it does for points closer to it than its radius of curvature.
std::size_t Trace::search(Point p) const {
    std::size_t low = 0, high = faces();
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        const Face f = face(middle);
        const bool passed = (p.x - f.a.x) * f.b.x + (p.y - f.a.y) * f.b.y >= 0.0;
        (passed ? low : high) = middle;
    }
    return low;
}

Point Trace::at(double place) const {
    const auto k = std::min(static_cast<std::size_t>(place), faces() - 1);
    const double t = place - static_cast<double>(k);
    const Face f = face(k);
    return {f.a.x + t * (f.b.x + t * f.c.x), f.a.y + t * (f.b.y + t * f.c.y)};
}

std::optional<TracePoint> Trace::nearest(Point p, double place) const {
    const bool known = place >= 0.0;
    std::size_t k = known ? std::min(static_cast<std::size_t>(place), faces() - 1) : search(p);
    double t = known ? place - static_cast<double>(k) : 0.5;
    Face f = face(k);
    int came_from = 0; // the side from which the face was entered
    for (std::size_t hops = 0;; ++hops) {
        // Newton's method for (X - p) X' = 0. A disc moves some 1e-4 of a face per cycle, so that
        // one step leaves 1e-8 faces; the foot's distance is then right to round-off.
        for (int n = 0; n < 8; ++n) {
            const Point from{f.a.x + t * (f.b.x + t * f.c.x) - p.x,
                             f.a.y + t * (f.b.y + t * f.c.y) - p.y};
            const Point tangent{f.b.x + 2.0 * t * f.c.x, f.b.y + 2.0 * t * f.c.y};
            const double slope = tangent.x * tangent.x + tangent.y * tangent.y +
                                 2.0 * (from.x * f.c.x + from.y * f.c.y);
            const double miss = from.x * tangent.x + from.y * tangent.y;
            // Far away, beyond the centre of curvature, there is no nearest point to converge to.
            const double step = slope > 0.0 ? miss / slope : 0.0;
            t = std::clamp(t - step, -0.5, 1.5);
            if (std::abs(step) < 1e-3)
                break;
        }
        if (t < 0.0) {
            if (k == 0) {
                if (p.y >= f.a.y)
                    return std::nullopt;
                t = 0.0;
                break;
            }
            if (came_from < 0 || hops > faces()) { // over a corner
                t = 0.0;
                break;
            }
            f = face(--k);
            t = 1.0;
            came_from = 1;
        } else if (t > 1.0) {
            if (k + 1 == faces())
                return std::nullopt;
            if (came_from > 0 || hops > faces()) {
                t = 1.0;
                break;
            }
            f = face(++k);
            t = 0.0;
            came_from = -1;
        } else {
            break;
        }
    }
    const Point tangent{f.b.x + 2.0 * t * f.c.x, f.b.y + 2.0 * t * f.c.y};
    const Point out{p.x - (f.a.x + t * (f.b.x + t * f.c.x)),
                    p.y - (f.a.y + t * (f.b.y + t * f.c.y))};
    // Along the line to the disc, not the wall's normal: then the force that acts at this point
    // has no moment but that of its shear, however well t is known.
    const double side = tangent.x * out.y - tangent.y * out.x < 0.0 ? -1.0 : 1.0;
    const double distance = std::sqrt(out.x * out.x + out.y * out.y);
    Foot foot{side * distance, {side * out.x / distance, side * out.y / distance}};
    if (distance < 1e-9) {
        const double length = std::sqrt(tangent.x * tangent.x + tangent.y * tangent.y);
        foot.normal = {-tangent.y / length, tangent.x / length};
    }
    // A place of 1 belongs to the next face, which has the same point.
    return TracePoint{foot, static_cast<double>(k) + t, degree_ * k,
                      shape_functions(static_cast<int>(degree_), t)};
}

} // namespace listric::dem
