#include "dem/genesis/detachment.hpp"

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace listric::dem {

namespace {

constexpr double high = 1e5; // m, higher than anything piles up

Surface right_wall(double length) {
    return {"right wall", {line({length, -high}, {length, high})}, 0.0, 0.0, {1.0, 0.0}};
}

Surface backstop() { return {"backstop", {line({0.0, high}, {0.0, 0.0})}}; }

/// Ends in a stub along the detachment, so that the corner at the breakaway belongs to it; all
/// beyond is the detachment's.
Surface footwall_top(const DetachmentParameters& detachment, const Segment& first) {
    constexpr double stub = 1e-6; // m
    const Point corner = first.start;
    return {.name = "footwall top",
            .chain = {line({corner.x - *detachment.footwall_top, corner.y}, corner),
                      line(corner, {corner.x + stub * first.start_tangent.x,
                                    corner.y + stub * first.start_tangent.y})},
            .friction = detachment.footwall_friction};
}

} // namespace

DetachmentSegment arc_to_dip(double end_dip, double radius, std::optional<double> start_dip) {
    return {DetachmentSegment::Kind::arc, radius, end_dip, 0.0, start_dip};
}

DetachmentSegment straight(double length, std::optional<double> start_dip) {
    return {DetachmentSegment::Kind::line, 0.0, 0.0, length, start_dip};
}

Chain detachment_chain(const DetachmentParameters& detachment, double reach) {
    const double degree = pi / 180.0;
    Chain chain;
    Point start{0.0, 0.0};
    double dip = detachment.start_dip;
    for (const DetachmentSegment& piece : detachment.segments) {
        dip = piece.start_dip.value_or(dip);
        const Point along{cosine(dip * degree), -sine(dip * degree)};
        if (piece.kind == DetachmentSegment::Kind::arc) {
            chain.push_back(arc(start, along, piece.radius, (dip - piece.end_dip) * degree));
            dip = piece.end_dip;
        } else {
            chain.push_back(
                line(start, {start.x + piece.length * along.x, start.y + piece.length * along.y}));
        }
        start = chain.back().end;
    }
    if (start.x < reach)
        chain.push_back(line(start, {reach, start.y}));
    return chain;
}

double runs_from(BaseKind base, const DetachmentParameters& detachment) {
    return base == BaseKind::sheet   ? runs_everywhere
           : base == BaseKind::rests ? runs_nowhere
                                     : sole_out(detachment_chain(detachment, 0.0));
}

RigidBase make_halfgraben(const DetachmentParameters& detachment, const Extent& extent,
                          const Material& material, const Motion& motion) {
    RigidBase base;
    base.material = material;
    base.motion = motion;
    base.motion.runs_from = runs_from(detachment.base, detachment);
    base.surfaces = {
        {.name = "detachment",
         .chain = detachment_chain(detachment, extent.reach()),
         .friction = detachment.friction,
         .conveyor = 1.0,
         .friction_rule = detachment.friction_rule},
        backstop(),
        right_wall(extent.length),
    };
    if (detachment.footwall_top)
        base.surfaces[1] = footwall_top(detachment, base.surfaces[0].chain.front());
    return base;
}

void stand_backstop(RigidBase& base) {
    for (Surface& surface : base.surfaces)
        if (surface.name == "footwall top")
            surface = backstop();
}

RigidBase make_box(const FlatBase& flat, const Extent& extent, const Material& material,
                   const Motion& motion) {
    RigidBase base;
    base.material = material;
    base.motion = motion;
    const double floor = -extent.thickness;
    const double angle = flat.fault ? flat.fault->dip * pi / 180.0 : 0.0;
    const Point down_dip{cosine(angle), -sine(angle)};
    const double slip = flat.fault ? flat.fault->slip : 0.0; // over the extension
    // What the fault's heave leaves of the walls' way apart.
    const double stretch = flat.stretches ? 1.0 - slip * down_dip.x : 0.0;
    Surface wall = right_wall(extent.length);
    wall.translation = {flat.stretches ? 1.0 : slip * down_dip.x, slip * down_dip.y};
    base.surfaces = {{.name = "base",
                      .chain = {line({0.0, floor}, {extent.reach(), floor})},
                      .friction = flat.friction,
                      .stretched_length = flat.stretches ? extent.length : 0.0,
                      .stretch = flat.fault ? stretch : 1.0},
                     {"left wall", {line({0.0, high}, {0.0, -high})}},
                     wall};
    if (!flat.fault)
        return base;
    Surface& left = base.surfaces.front();
    const Point cutoff{flat.fault->x, floor};
    const double depth = extent.reach() * std::max(1.0, std::abs(slip)); // more than ever slips
    const Point deep{cutoff.x + depth * down_dip.x, cutoff.y + depth * down_dip.y};
    left.translation = {stretch * cutoff.x / extent.length, 0.0};
    left.stretched_from = cutoff.x;
    Surface right = left;
    const double start = -std::max(0.0, left.translation.x * extent.distance);
    left.chain = {line({start, floor}, cutoff), line(cutoff, deep)};
    right.name = basement_block;
    right.chain = {line(deep, cutoff), line(cutoff, {extent.reach(), floor})};
    right.translation = {left.translation.x + slip * down_dip.x, slip * down_dip.y};
    base.surfaces.push_back(right);
    return base;
}

void follow_nodes(RigidBase& base, int degree) {
    assert(base.surfaces.size() >= 2 && degree >= 1);
    base.surfaces[0].follows = Follows::nodes;
    base.surfaces[0].degree = degree;
    base.surfaces[1].follows = Follows::breakaway;
}

} // namespace listric::dem
