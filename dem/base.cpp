#include "dem/base.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace listric::dem {

namespace {

Point left_normal(Point tangent) { return {-tangent.y, tangent.x}; }

Point centre(const Segment& s) {
    const Point n = left_normal(s.start_tangent);
    const double radius = 1.0 / s.curvature;
    return {s.start.x + n.x * radius, s.start.y + n.y * radius};
}

/// Foot if it lies on the segment itself. An arc turns by less than pi, so the two half-planes
/// between its ends hold no other points.
std::optional<Foot> foot_on(const Segment& s, Point p) {
    if (dot(p - s.start, s.start_tangent) < 0.0 || dot(p - s.end, s.end_tangent) > 0.0)
        return std::nullopt;
    if (s.curvature == 0.0) {
        const Point n = left_normal(s.start_tangent);
        return Foot{dot(p - s.start, n), n};
    }
    const Point from_centre = p - centre(s);
    const double r = std::sqrt(dot(from_centre, from_centre));
    if (r == 0.0)
        return std::nullopt;
    const double side = s.curvature > 0.0 ? 1.0 : -1.0;
    return Foot{side * (std::abs(1.0 / s.curvature) - r),
                {-side * from_centre.x / r, -side * from_centre.y / r}};
}

/// The corner at the end of segment `s`, if no other point of the two segments is closest to p:
/// over a corner that points into the material, or beyond one that points out of it.
std::optional<Foot> corner(const Segment& s, const Segment& next, Point p) {
    const Point out = p - s.end;
    const double distance = std::sqrt(dot(out, out));
    if (dot(out, s.end_tangent) <= 0.0 || dot(out, next.start_tangent) >= 0.0 || distance == 0.0)
        return std::nullopt;
    // Over a tip sharper than a right angle the chain's turn says where the material is.
    const bool is_sharp = dot(s.end_tangent, next.start_tangent) < 0.0;
    const double left =
        is_sharp ? cross(next.start_tangent, s.end_tangent) : cross(s.end_tangent, out);
    const double side = left < 0.0 ? -1.0 : 1.0;
    return Foot{side * distance, {side * out.x / distance, side * out.y / distance}};
}

struct Found {
    Foot foot;
    std::size_t segment;
    bool at_corner;
};

std::optional<Found> search(const Chain& chain, Point p) {
    std::optional<Found> best;
    const auto consider = [&](const std::optional<Foot>& foot, std::size_t k, bool at_corner) {
        if (foot && (!best || std::abs(foot->distance) < std::abs(best->foot.distance)))
            best = Found{*foot, k, at_corner};
    };
    for (std::size_t k = 0; k < chain.size(); ++k) {
        consider(foot_on(chain[k], p), k, false);
        if (k + 1 < chain.size())
            consider(corner(chain[k], chain[k + 1], p), k, true);
    }
    return best;
}

} // namespace

Segment line(Point start, Point end) {
    const double length = hypotenuse(end.x - start.x, end.y - start.y);
    const Point t{(end.x - start.x) / length, (end.y - start.y) / length};
    return {start, end, t, t, length, 0.0};
}

Segment arc(Point start, Point tangent, double radius, double turn) {
    assert(radius > 0.0 && std::abs(turn) < std::numbers::pi);
    assert(std::abs(dot(tangent, tangent) - 1.0) < 1e-9);
    const double side = turn > 0.0 ? 1.0 : -1.0;
    const Point n = left_normal(tangent);
    const Point c{start.x + side * radius * n.x, start.y + side * radius * n.y};
    const double cosine = dem::cosine(turn), sine = dem::sine(turn);
    const Point from_centre = start - c;
    return {start,
            {c.x + cosine * from_centre.x - sine * from_centre.y,
             c.y + sine * from_centre.x + cosine * from_centre.y},
            tangent,
            {cosine * tangent.x - sine * tangent.y, sine * tangent.x + cosine * tangent.y},
            radius * std::abs(turn),
            side / radius};
}

std::optional<Foot> nearest(const Chain& chain, Point p) {
    const auto found = search(chain, p);
    return found ? std::optional(found->foot) : std::nullopt;
}

std::optional<FootPoint> foot_point(const Chain& chain, Point p) {
    const auto found = search(chain, p);
    if (!found)
        return std::nullopt;
    double arc_length = 0.0;
    for (std::size_t k = 0; k < found->segment; ++k)
        arc_length += chain[k].length;
    const Segment& s = chain[found->segment];
    if (found->at_corner)
        arc_length += s.length;
    else if (s.curvature == 0.0)
        arc_length += dot(p - s.start, s.start_tangent);
    else {
        const Point c = centre(s);
        const double turn = arc_tangent(cross(s.start - c, p - c), dot(s.start - c, p - c));
        arc_length += std::abs(turn / s.curvature);
    }
    return FootPoint{found->foot, arc_length};
}

std::optional<Foot> nearest(const Surface& surface, double extension, Point p) {
    return nearest(surface.chain, {p.x - surface.translation.x * extension,
                                   p.y - surface.translation.y * extension});
}

Chain moved(Chain chain, Point by) {
    for (Segment& s : chain) {
        s.start = {s.start.x + by.x, s.start.y + by.y};
        s.end = {s.end.x + by.x, s.end.y + by.y};
    }
    return chain;
}

void place(Surface& surface, const Chain& chain, Point translation, double extension) {
    surface.chain = moved(chain, {-translation.x * extension, -translation.y * extension});
    surface.translation = translation;
}

const Surface* find_basement_block(const RigidBase& base) {
    const auto found = std::ranges::find(base.surfaces, basement_block, &Surface::name);
    return found == base.surfaces.end() ? nullptr : &*found;
}

Chain base_line(const RigidBase& base, double extension) {
    const Surface& first = base.surfaces.front();
    const Surface* const block = find_basement_block(base);
    if (!block)
        return first.chain;
    const auto now = [&](const Surface& surface) {
        return moved(surface.chain,
                     {surface.translation.x * extension, surface.translation.y * extension});
    };
    const Segment left = now(first).front(), right = now(*block).back();
    constexpr double least = 1e-9; // m
    Chain whole{left};
    if (hypotenuse(right.start.x - left.end.x, right.start.y - left.end.y) > least)
        whole.push_back(line(left.end, right.start));
    whole.push_back(right);
    return whole;
}

void join_blocks(RigidBase& base, double extension) {
    if (!find_basement_block(base))
        return;
    base.surfaces.front().chain = base_line(base, extension);
    base.surfaces.front().translation = {};
    std::erase_if(base.surfaces, [](const Surface& s) { return s.name == basement_block; });
}

double wall_way(const RigidBase& base, double extension) {
    const auto wall = std::ranges::find(base.surfaces, "right wall", &Surface::name);
    return wall == base.surfaces.end() ? extension : wall->translation.x * extension;
}

Stretching stretching(const RigidBase& base, double extension, double speed) {
    for (const Surface& surface : base.surfaces)
        if (surface.stretched_length > 0.0 && surface.translation == Point{})
            return {1.0 / (surface.stretched_length + extension) * speed,
                    surface.chain.front().start.y};
    return {};
}

double greatest_translation(const RigidBase& base) {
    double greatest = 0.0;
    for (const Surface& surface : base.surfaces)
        greatest = std::max(greatest, hypotenuse(surface.translation.x, surface.translation.y));
    return greatest;
}

double length_of(const Chain& chain) {
    double sum = 0.0;
    for (const Segment& s : chain)
        sum += s.length;
    return sum;
}

double sole_out(const Chain& chain) {
    constexpr double level = 1e-9; // round-off of an arc's end
    double x = chain.empty() ? 0.0 : chain.back().end.x;
    for (std::size_t k = chain.size(); k-- > 0;) {
        const Segment& piece = chain[k];
        if (piece.curvature != 0.0 || std::abs(piece.start_tangent.y) > level)
            break;
        x = piece.start.x;
    }
    return x;
}

double height_at(const Chain& chain, double x) {
    double low = 0.0, high = length_of(chain);
    for (int n = 0; n < 60; ++n) { // to round-off
        const double middle = 0.5 * (low + high);
        (point_at(chain, middle).x < x ? low : high) = middle;
    }
    return point_at(chain, low).y;
}

Point point_at(const Chain& chain, double arc_length) {
    assert(!chain.empty());
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
        const double cosine = dem::cosine(turn), sine = dem::sine(turn);
        const Point from_centre = s.start - c;
        return {c.x + cosine * from_centre.x - sine * from_centre.y,
                c.y + sine * from_centre.x + cosine * from_centre.y};
    }
    return {};
}

} // namespace listric::dem
