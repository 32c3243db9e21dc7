#include "dem/cycle_physics.hpp"

#include "dem/columns.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace listric::dem {

void add_mean_velocities(State& state) {
    state.discs.add(columns::mean_vx);
    state.discs.add(columns::mean_vy);
}

void refuse_runaways(const State& state) {
    if (!(state.displacement_bound < 10.0 * state.mean_radius))
        refuse_displaced(state);
}

void refuse_displaced(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (!(hypotenuse(d.x[i] - d.searched_x[i], d.y[i] - d.searched_y[i]) <
              10.0 * state.mean_radius))
            throw NumericalFailure("disc " + std::to_string(d.id[i]) +
                                   " ran away at x = " + std::to_string(d.x[i]) +
                                   " m, y = " + std::to_string(d.y[i]) + " m (velocity " +
                                   std::to_string(d.vx[i]) + ", " + std::to_string(d.vy[i]) +
                                   " m/s, cycle " + std::to_string(state.clock.cycle) + ")");
}

double stable_time_step(double mass, const Material& m, double damping, double safety) {
    const double normal = 0.5 * m.normal_stiffness, shear = 0.5 * m.shear_stiffness;
    const double stiffness = std::max(3.0 * (normal + shear), 12.0 * shear);
    return safety * std::sqrt(2.0 * mass / (stiffness * (1.0 + damping)));
}

} // namespace listric::dem
