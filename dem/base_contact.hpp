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

/// Force of one surface on one disc; both cycles use it. `speed` (m/s) and `extension` (m) are the
/// base's, `parameters` the stiffness of surface and disc in series. Updates the shear force.
inline BaseContactForce base_contact_force(const Surface& surface, double extension, double speed,
                                           const BaseContactDisc& disc,
                                           ContactParameters parameters, double& shear_force) {
    const auto foot = nearest(surface, extension, {disc.x, disc.y});
    if (!foot || foot->distance >= disc.radius) {
        shear_force = 0.0;
        return {0.0, 0.0, 0.0};
    }
    const double nx = foot->normal.x, ny = foot->normal.y;
    // The conveyor runs along the chain, whose direction is (n_y, -n_x).
    double wall_vx = speed * (surface.translation.x + surface.conveyor * ny);
    if (surface.stretched_length > 0.0)
        wall_vx += speed * disc.x / (surface.stretched_length + extension);
    const double wall_vy = speed * (surface.translation.y - surface.conveyor * nx);
    const double slip_rate =
        (disc.vy - wall_vy) * nx - (disc.vx - wall_vx) * ny - disc.spin * foot->distance;
    parameters.friction = static_cast<float>(surface.friction);
    std::uint8_t bonded = 0;
    const double normal = contact_force(disc.radius - foot->distance, slip_rate, parameters, 0.0f,
                                        0.0f, shear_force, bonded);
    return {normal * nx - shear_force * ny, normal * ny + shear_force * nx,
            -(foot->distance * shear_force)};
}

} // namespace listric
