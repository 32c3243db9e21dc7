#pragma once

#include "dem/state.hpp"

#include <cmath>

namespace listric::dem {

/// Sum of the forces on a disc.
struct Force {
    double x, y, moment; ///< N, N, N m
};

/// How two discs lie and move past each other.
struct Pair {
    double nx, ny;       ///< from the first to the second
    double overlap;      ///< m
    double arm_i, arm_j; ///< m
    double slip_rate;    ///< m/s
};

inline Pair pair_of(const DiscColumns& d, std::size_t i, std::size_t j, double dx, double dy,
                    double square) {
    const double distance = std::sqrt(square);
    const double inverse = 1.0 / distance;
    const double nx = dx * inverse, ny = dy * inverse;
    const double overlap = d.radius[i] + d.radius[j] - distance;
    const double half = 0.5 * overlap;
    const double arm_i = d.radius[i] - half, arm_j = d.radius[j] - half;
    const double slip_rate = (d.vy[j] - d.vy[i]) * nx - (d.vx[j] - d.vx[i]) * ny -
                             (arm_i * d.spin[i] + arm_j * d.spin[j]);
    return {nx, ny, overlap, arm_i, arm_j, slip_rate};
}

} // namespace listric::dem
