#pragma once

// A bonded lattice that vibrates without losses.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"

namespace listric::support {

using namespace dem;

inline double square(double a) { return a * a; }

/// A bonded lattice of 4 x 4 discs in random motion without losses.
inline State shaken(double step_share) {
    constexpr double r = 93.1, speed = 1e-3; // m/s; strains are 1e-7
    State state = make_state(hexagonal(4, 4, r));
    bond_all(state, {});
    const DiscColumns d = disc_columns(state);
    state.clock.time_step = stable_time_step(d.mass[0], state.materials[basement], 0.0, step_share);
    // Without momentum: the lattice stays where it is.
    Random random(5);
    const auto n = static_cast<double>(d.x.size());
    double vx = 0.0, vy = 0.0, x = 0.0, y = 0.0, angular = 0.0, inertia = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        vx += (d.vx[i] = speed * random.between(-1.0, 1.0)) / n;
        vy += (d.vy[i] = speed * random.between(-1.0, 1.0)) / n;
        d.spin[i] = speed / r * random.between(-1.0, 1.0);
        x += d.x[i] / n;
        y += d.y[i] / n;
    }
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.vx[i] -= vx;
        d.vy[i] -= vy;
        angular += (d.x[i] - x) * d.vy[i] - (d.y[i] - y) * d.vx[i] + 0.5 * r * r * d.spin[i];
        inertia += square(d.x[i] - x) + square(d.y[i] - y) + 0.5 * r * r;
    }
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.vx[i] += angular / inertia * (d.y[i] - y);
        d.vy[i] -= angular / inertia * (d.x[i] - x);
        d.spin[i] -= angular / inertia;
        // One step after the state without forces: shear forces know velocities only.
        d.x[i] += d.vx[i] * state.clock.time_step;
        d.y[i] += d.vy[i] * state.clock.time_step;
    }
    return state;
}

} // namespace listric::support
