#pragma once

#include "dem/material.hpp"
#include "dem/motion.hpp"
#include "dem/numbers/point.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric::dem {

/// Straight or circular piece of a chain. The material lies to the left of its direction.
struct Segment {
    Point start, end;                 ///< m
    Point start_tangent, end_tangent; ///< unit vectors along the chain's direction
    double length = 0.0;              ///< m
    double curvature = 0.0; ///< 1/m; 0 line, > 0 turns left (centre on the material's side)
};

Segment line(Point start, Point end);

/// Arc that leaves `start` along `tangent` (unit vector) and turns by `turn` rad (> 0 left).
/// |turn| must be below pi.
Segment arc(Point start, Point tangent, double radius, double turn);

/// The point of a surface closest to a disc's centre.
struct Foot {
    double distance = 0.0; ///< m; negative when the centre is beyond the surface
    Point normal;          ///< unit vector into the material
};

struct FootPoint : Foot {
    double arc_length = 0.0; ///< m from the chain's start
};

/// Segments joined end to end.
using Chain = std::vector<Segment>;

/// Closest point on the chain, its corners included. None if one of the chain's open ends is
/// closest: a surface ends where it ends.
std::optional<Foot> nearest(const Chain& chain, Point p);

/// Foot on a chain, with its place.
std::optional<FootPoint> foot_point(const Chain& chain, Point p);

double length_of(const Chain& chain); ///< m

Point point_at(const Chain& chain, double arc_length);

/// x from which on a chain is level up to its end: its sole-out point, m.
double sole_out(const Chain& chain);

/// Height of a chain whose x ascends, at x, m; beyond an end, the height of that end.
double height_at(const Chain& chain, double x);

/// Part of a surface in a base that deforms (State::base_nodes).
enum class Follows {
    nothing,  ///< it is rigid
    nodes,    ///< it is the line through the nodes instead of its chain
    breakaway ///< its chain is displaced as the first node is
};

/// Whose friction a contact with a surface has.
enum class FrictionRule {
    wall,   ///< the surface's own
    smaller ///< the smaller of surface and disc, as PFC has it for walls, too
};

/// A surface and how it moves. Velocities are in units of the extension speed.
struct Surface {
    std::string name;
    Chain chain;
    double friction = 0.0;
    double conveyor = 0.0;  ///< its material runs along the chain with this speed
    Point translation = {}; ///< its velocity: it is at chain + translation * extension
    /// If above 0, m, its material stretches: beside `translation` it moves along x in proportion
    /// to the distance from where stretched_from has come to, and over stretched_length by
    /// `stretch`.
    double stretched_length = 0.0;
    double stretch = 1.0;        ///< of the extension, between the walls
    double stretched_from = 0.0; ///< x of the material that goes with `translation`, m
    Follows follows = Follows::nothing;
    int degree = 2; ///< of the faces between nodes
    FrictionRule friction_rule = FrictionRule::wall;
};

/// Closest point of a surface at an extension, m, where nothing deforms; as for its chain.
std::optional<Foot> nearest(const Surface& surface, double extension, Point p);

/// The chain moved by a vector, m.
Chain moved(Chain chain, Point by);

/// Puts a surface where `chain` is at an extension, m, and lets it move from there. Neighbour lists
/// must learn of it: find_surface_contacts().
void place(Surface& surface, const Chain& chain, Point translation, double extension);

/// Surfaces that the discs rest on: detachment, backstop above the breakaway and right wall; or the
/// walls of a box.
struct RigidBase {
    std::vector<Surface> surfaces;
    Material material; ///< stiffness of the surfaces, in series with the disc's
    Motion motion;
};

/// Name of the surface that is the basement on the right of a fault. What rests on it leaves it for
/// the first surface, the basement on the left, over the scarp that one of them has.
inline constexpr const char* basement_block = "basement block";

/// The basement on the right of a fault; null where no fault cuts the base.
const Surface* find_basement_block(const RigidBase& base);

/// What discs rest on as one line from left to right at an extension, m: the first surface, or both
/// blocks of a basement and the scarp between them.
Chain base_line(const RigidBase& base, double extension);

/// Makes that line the first surface, at rest, in place of two blocks.
void join_blocks(RigidBase& base, double extension);

/// Way of the right wall along x at an extension, m; the extension itself where none is named.
double wall_way(const RigidBase& base, double extension);

/// Thinning of what rests on a base that stretches as a whole: du_x/dx = -du_y/dy.
struct Stretching {
    double rate = 0.0;  ///< 1/s; 0: nothing stretches
    double floor = 0.0; ///< y at which nothing sinks, m
};

/// At an extension, m, that grows by `speed`, m/s.
Stretching stretching(const RigidBase& base, double extension, double speed);

/// Greatest translation of a surface, in units of the extension speed.
double greatest_translation(const RigidBase& base);

} // namespace listric::dem
