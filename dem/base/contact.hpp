#pragma once

#include "dem/base.hpp"
#include "dem/base/place.hpp"
#include "dem/law.hpp"
#include "dem/numbers/order_free.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>

namespace listric::dem {

/// The base in a cycle: what of it changes with time where it does not deform.
struct BaseInstant {
    double extension;                    ///< m
    double speed;                        ///< of extension, m/s; below 0: shortening
    double runs_from = runs_everywhere;  ///< x from which on the detachment's material runs, m
    std::optional<double> friction = {}; ///< of the detachment, in place of the surface's
};

inline BaseInstant base_instant(const MotionInstant& motion, double extension) {
    return {extension, motion.speed, motion.runs_from, motion.friction};
}

inline BaseInstant base_instant(const RigidBase& base, const Clock& clock) {
    return base_instant(base.motion.at(clock.time(), clock.travel), clock.extension.m);
}

/// Friction of a surface now.
inline double friction_of(const Surface& surface, const BaseInstant& now) {
    return now.friction && surface.conveyor != 0.0 ? *now.friction : surface.friction;
}

/// A disc as a surface sees it.
struct BaseContactDisc {
    double x, y, vx, vy, spin, radius; ///< m, m/s, rad/s, m
};

/// Force of a surface on a disc, N and N m.
struct BaseContactForce {
    double x, y, moment;
};

/// Speed at which a disc slips past the closest point of a surface, m/s.
inline double slip_rate_on(const Foot& foot, Point wall_velocity, const BaseContactDisc& disc) {
    return (disc.vy - wall_velocity.y) * foot.normal.x -
           (disc.vx - wall_velocity.x) * foot.normal.y - disc.spin * foot.distance;
}

/// Stands for the memory of rolling, a moment in N m, where nothing resists it, at no cost.
struct FreeRolling {};
template <class Rolling> inline constexpr bool rolls = !std::is_same_v<Rolling, FreeRolling>;

/// Force on a disc whose closest point of a surface is known and moves with `wall_velocity`, m/s.
/// Updates the shear force and the moment against rolling; surfaces do not turn.
template <class Rolling>
BaseContactForce surface_force(const Surface& surface, const BaseInstant& now, const Foot& foot,
                               Point wall_velocity, const BaseContactDisc& disc,
                               ContactParameters parameters, double& shear_force,
                               [[maybe_unused]] Rolling& rolling) {
    const double nx = foot.normal.x, ny = foot.normal.y;
    const double slip_rate = slip_rate_on(foot, wall_velocity, disc);
    const auto friction = static_cast<float>(friction_of(surface, now));
    parameters.friction = surface.friction_rule == FrictionRule::smaller
                              ? std::min(friction, parameters.friction)
                              : friction;
    std::uint8_t bonded = 0;
    const double normal = contact_force(disc.radius - foot.distance, slip_rate, parameters, 0.0f,
                                        0.0f, shear_force, bonded);
    BaseContactForce force{normal * nx - shear_force * ny, normal * ny + shear_force * nx,
                           -(foot.distance * shear_force)};
    if constexpr (rolls<Rolling>) {
        parameters.rolling_friction = std::min(parameters.rolling_friction, parameters.friction);
        rolling = rolling_moment(rolling, disc.spin, disc.radius, normal, parameters);
        force.moment += rolling;
    }
    return force;
}

/// Speed along the chain of a surface's material at x, in units of the extension speed.
inline double conveyor_at(const Surface& surface, const BaseInstant& now, double x) {
    return x >= now.runs_from ? surface.conveyor : 0.0;
}

/// x of the point of a rigid surface that is closest to a disc, m.
inline double x_of_foot(const Foot& foot, const BaseContactDisc& disc) {
    return disc.x - foot.distance * foot.normal.x;
}

/// Speed along x of a stretching surface at x, beside its translation, in units of the extension
/// speed.
inline double stretch_at(const Surface& surface, double extension, double x) {
    return surface.stretch * (x - (surface.stretched_from + surface.translation.x * extension)) /
           (surface.stretched_length + surface.stretch * extension);
}

/// Velocity of a surface where it has a normal and the x of `place`, below a disc at x, m/s. The
/// conveyor runs along the chain, whose direction is (n_y, -n_x).
inline Point surface_velocity(const Surface& surface, const BaseInstant& now, double x,
                              double place, Point normal) {
    const double conveyor = conveyor_at(surface, now, place);
    double along = surface.translation.x + conveyor * normal.y;
    if (surface.stretched_length > 0.0)
        along += stretch_at(surface, now.extension, x);
    return {now.speed * along, now.speed * (surface.translation.y - conveyor * normal.x)};
}

/// Where a rigid surface and a disc meet and how they move past each other.
struct BaseContactMotion {
    Foot foot;
    double slip_rate; ///< m/s
};

/// None where the surface has ended.
inline std::optional<BaseContactMotion>
base_contact_motion(const Surface& surface, const BaseInstant& now, const BaseContactDisc& disc) {
    const auto foot = nearest(surface, now.extension, {disc.x, disc.y});
    if (!foot)
        return std::nullopt;
    const Point velocity =
        surface_velocity(surface, now, disc.x, x_of_foot(*foot, disc), foot->normal);
    return BaseContactMotion{*foot, slip_rate_on(*foot, velocity, disc)};
}

/// Force of one rigid surface on one disc; both cycles use it. `parameters` are the stiffness of
/// surface and disc in series. Updates the shear force and the moment against rolling.
template <class Rolling>
BaseContactForce base_contact_force(const Surface& surface, const BaseInstant& now,
                                    const BaseContactDisc& disc, ContactParameters parameters,
                                    double& shear_force, Rolling& rolling) {
    const auto foot = nearest(surface, now.extension, {disc.x, disc.y});
    if (!foot || foot->distance >= disc.radius) {
        shear_force = 0.0;
        rolling = {};
        return {0.0, 0.0, 0.0};
    }
    return surface_force(
        surface, now, *foot,
        surface_velocity(surface, now, disc.x, x_of_foot(*foot, disc), foot->normal), disc,
        parameters, shear_force, rolling);
}

/// Force of a surface that deforms, and to which nodes it goes back.
struct NodeContactForce {
    BaseContactForce force = {0.0, 0.0, 0.0};
    std::size_t node = 0;              ///< first of the face
    std::array<double, 3> weight = {}; ///< of its nodes; all 0: the force goes to none
};

/// Where a surface that deforms is closest to a disc, and how that point moves with the nodes.
struct NodeContactMotion {
    std::optional<Foot> foot;
    std::size_t node = 0;              ///< first of the face
    std::array<double, 3> weight = {}; ///< of its nodes; all 0: the force goes to none
    double x = 0.0;                    ///< of that point where the base is without load, m
    Point velocity;                    ///< of the nodes there, m/s
};

/// `place` is the contact's place on the surface, found anew from there. What presses on the
/// backstop goes to no node: it stands for nothing that bends.
template <class NodeColumns>
NodeContactMotion node_contact_motion(const Surface& surface, const NodeColumns& nodes,
                                      double extension, const BaseContactDisc& disc,
                                      double& place) {
    const BasePlace base{extension, nodes.x, nodes.y, nodes.ux, nodes.uy};
    NodeContactMotion motion;
    if (surface.follows == Follows::breakaway) {
        motion.foot = nearest(surface, base, {disc.x, disc.y});
        motion.velocity = {nodes.vx[0], nodes.vy[0]};
    } else if (const auto point = base.trace(surface).nearest({disc.x, disc.y}, place)) {
        motion.foot = point->foot;
        place = point->place;
        motion.node = point->node;
        motion.weight = point->weight;
        for (std::size_t k = 0; k <= static_cast<std::size_t>(surface.degree); ++k) {
            motion.x += motion.weight[k] * nodes.x[motion.node + k];
            motion.velocity.x += motion.weight[k] * nodes.vx[motion.node + k];
            motion.velocity.y += motion.weight[k] * nodes.vy[motion.node + k];
        }
    } else {
        place = -1.0;
    }
    return motion;
}

/// How the disc moves past it; none where the surface has ended.
inline std::optional<BaseContactMotion> surface_motion(const Surface& surface,
                                                       const NodeContactMotion& motion,
                                                       const BaseInstant& now,
                                                       const BaseContactDisc& disc) {
    if (!motion.foot)
        return std::nullopt;
    const Point runs = surface_velocity(surface, now, disc.x, motion.x, motion.foot->normal);
    const Point velocity{motion.velocity.x + runs.x, motion.velocity.y + runs.y};
    return BaseContactMotion{*motion.foot, slip_rate_on(*motion.foot, velocity, disc)};
}

/// The force of a surface that deforms; updates shear force, moment against rolling and place. The
/// moment loads no node.
template <class Rolling>
NodeContactForce node_contact_force(const Surface& surface, const BaseNodeColumns& nodes,
                                    const BaseInstant& now, const BaseContactDisc& disc,
                                    ContactParameters parameters, double& shear_force,
                                    double& place, Rolling& rolling) {
    const NodeContactMotion motion =
        node_contact_motion(surface, nodes, now.extension, disc, place);
    if (!motion.foot || motion.foot->distance >= disc.radius) {
        shear_force = 0.0;
        rolling = {};
        return {};
    }
    const Point runs = surface_velocity(surface, now, disc.x, motion.x, motion.foot->normal);
    const BaseContactForce force = surface_force(
        surface, now, *motion.foot, {motion.velocity.x + runs.x, motion.velocity.y + runs.y}, disc,
        parameters, shear_force, rolling);
    return {force, motion.node, motion.weight};
}

/// Adds what a disc does to the wall to the loads of the nodes.
inline void add_load(const BaseNodeColumns& nodes, const NodeContactForce& f, int degree) {
    if (f.weight[0] == 0.0 && f.weight[1] == 0.0 && f.weight[2] == 0.0)
        return;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree); ++k) {
        nodes.load_x[f.node + k] -= load_units(f.weight[k] * f.force.x);
        nodes.load_y[f.node + k] -= load_units(f.weight[k] * f.force.y);
    }
}

} // namespace listric::dem
