#pragma once

#include "dem/base.hpp"
#include "dem/law.hpp"

#include <optional>

namespace listric {

/// A disc as a surface sees it.
struct BaseContactDisc {
    double x, y, vx, vy, spin, radius; ///< m, m/s, rad/s, m
};

/// Force of a surface on a disc, N and N m.
struct BaseContactForce {
    double x, y, moment;
};

/// Where a surface and a disc meet and how they move past each other.
struct BaseContactMotion {
    Foot foot;
    double slip_rate; ///< m/s
};

/// None where the surface has ended. `speed` (m/s) and `extension` (m) are the base's.
inline std::optional<BaseContactMotion> base_contact_motion(const Surface& surface,
                                                            double extension, double speed,
                                                            const BaseContactDisc& disc) {
    const auto foot = nearest(surface, extension, {disc.x, disc.y});
    if (!foot)
        return std::nullopt;
    const double nx = foot->normal.x, ny = foot->normal.y;
    // The conveyor runs along the chain, whose direction is (n_y, -n_x).
    const double wall_vx = speed * (surface.translation.x + surface.conveyor * ny);
    const double wall_vy = speed * (surface.translation.y - surface.conveyor * nx);
    const double slip_rate =
        (disc.vy - wall_vy) * nx - (disc.vx - wall_vx) * ny - disc.spin * foot->distance;
    return BaseContactMotion{*foot, slip_rate};
}

/// Force of one surface on one disc; both cycles use it. `speed` (m/s) and `extension` (m) are the
/// base's, `parameters` the stiffness of surface and disc in series. Updates the shear force.
inline BaseContactForce base_contact_force(const Surface& surface, double extension, double speed,
                                           const BaseContactDisc& disc,
                                           ContactParameters parameters, double& shear_force) {
    const auto motion = base_contact_motion(surface, extension, speed, disc);
    if (!motion || motion->foot.distance >= disc.radius) {
        shear_force = 0.0;
        return {0.0, 0.0, 0.0};
    }
    const double distance = motion->foot.distance;
    const double nx = motion->foot.normal.x, ny = motion->foot.normal.y;
    parameters.friction = static_cast<float>(surface.friction);
    std::uint8_t bonded = 0;
    const double normal = contact_force(disc.radius - distance, motion->slip_rate, parameters, 0.0f,
                                        0.0f, shear_force, bonded);
    return {normal * nx - shear_force * ny, normal * ny + shear_force * nx,
            -(distance * shear_force)};
}

} // namespace listric
