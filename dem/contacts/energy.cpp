#include "dem/contacts/energy.hpp"

#include "dem/base/contact.hpp"
#include "dem/columns.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/pushes.hpp"
#include "dem/radius_rates.hpp"
#include "dem/rolling.hpp"

#include <algorithm>
#include <cmath>

namespace listric::dem {

namespace {

/// Energy of a normal spring whose overlap was `before` at the last force and is `now`.
double normal_energy(double before, double now, bool bonded, const ContactParameters& p) {
    const double pressed = bonded ? before : std::max(before, 0.0);
    return 0.5 * static_cast<double>(p.normal_stiffness) * pressed * now;
}

/// Energy of a spring that the next slip, m/s, would bring from `force` elsewhere, N; or rolling,
/// rad/s, from a moment, N m.
double shear_energy(double force, double slip_rate, double stiffness_times_step, double time_step) {
    if (force == 0.0)
        return 0.0;
    return 0.5 * force * (force - stiffness_times_step * slip_rate) * time_step /
           stiffness_times_step;
}

/// Energy of the springs against rolling.
double rolling_energy(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const double dt = state.clock.time_step;
    const PairParameters pairs(state.materials, dt);
    const auto moments = rolling_moments(state.contacts),
               of_base = rolling_moments(state.base_contacts);
    double energy = 0.0;
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        const double lever = d.radius[i] * d.radius[j] / (d.radius[i] + d.radius[j]);
        energy += shear_energy(
            moments[k], d.spin[j] - d.spin[i],
            rolling_stiffness_times_step(pairs(d.material[i], d.material[j]), lever), dt);
    }
    for (std::size_t k = 0; k < of_base.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.disc[k]);
        const ContactParameters p =
            base_contact_parameters(base.material, state.materials[d.material[i]], dt);
        energy +=
            shear_energy(of_base[k], d.spin[i], rolling_stiffness_times_step(p, d.radius[i]), dt);
    }
    return energy;
}

} // namespace

StoredEnergy stored_energy(const State& state, const RigidBase& base, double gravity) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const Clock& clock = state.clock;
    const double dt = clock.time_step;
    const Pushes pushes(state);
    const RadiusRates radii(state);
    StoredEnergy energy;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double inertia = std::max(d.mass[i], state.inertial_mass_floor);
        const double surface = radii.of_inertia(i, d.radius[i]) * d.spin[i];
        energy.kinetic +=
            0.5 * inertia * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i] + 0.5 * surface * surface);
        energy.potential += d.mass[i] * gravity * (d.y[i] - 0.5 * dt * d.vy[i]);
        energy.push_potential -= pushes[i].x * (d.x[i] - 0.5 * dt * d.vx[i]) +
                                 pushes[i].y * (d.y[i] - 0.5 * dt * d.vy[i]);
    }

    const PairParameters pairs(state.materials, dt);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        const double dvx = d.vx[j] - d.vx[i], dvy = d.vy[j] - d.vy[i];
        const double reach = d.radius[i] + d.radius[j];
        const double distance = std::sqrt(dx * dx + dy * dy);
        const double before =
            reach - (radii[i] + radii[j]) * dt - hypotenuse(dx - dvx * dt, dy - dvy * dt);
        const double now = reach - distance;
        const ContactParameters& p = pairs(d.material[i], d.material[j]);
        energy.normal_strain += normal_energy(before, now, c.bonded[k], p);
        const double slip_rate = (dvy * dx - dvx * dy) / distance -
                                 (d.radius[i] - 0.5 * now) * d.spin[i] -
                                 (d.radius[j] - 0.5 * now) * d.spin[j];
        energy.shear_strain += shear_energy(c.shear_force[k], slip_rate,
                                            static_cast<double>(p.shear_stiffness_times_step), dt);
    }

    const BaseInstant instant = base_instant(base, clock);
    const double speed_before = base.motion.speed_at(std::max(0.0, clock.time() - dt));
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    std::vector<double> ux_before(nodes.x.size()), uy_before(nodes.x.size());
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        ux_before[k] = nodes.ux[k] - nodes.vx[k] * dt;
        uy_before[k] = nodes.uy[k] - nodes.vy[k] * dt;
    }
    for (std::size_t k = 0; k < b.disc.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.disc[k]);
        const Surface& surface = base.surfaces[static_cast<std::size_t>(b.surface[k])];
        const ContactParameters p =
            base_contact_parameters(base.material, state.materials[d.material[i]], dt);
        const BaseContactDisc disc{d.x[i], d.y[i], d.vx[i], d.vy[i], d.spin[i], d.radius[i]};
        const BasePlace before{clock.extension.m - speed_before * dt, nodes.x, nodes.y, ux_before,
                               uy_before};
        std::optional<BaseContactMotion> motion;
        if (before.deforms(surface)) {
            double place = state.base_contacts.get(columns::place)[k];
            motion = surface_motion(
                surface, node_contact_motion(surface, nodes, clock.extension.m, disc, place),
                instant, disc);
        } else {
            motion = base_contact_motion(surface, instant, disc);
        }
        const auto foot_before =
            nearest(surface, before, {d.x[i] - d.vx[i] * dt, d.y[i] - d.vy[i] * dt});
        if (motion && foot_before)
            energy.normal_strain +=
                normal_energy(d.radius[i] - radii[i] * dt - foot_before->distance,
                              d.radius[i] - motion->foot.distance, false, p);
        energy.shear_strain += shear_energy(b.shear_force[k], motion ? motion->slip_rate : 0.0,
                                            static_cast<double>(p.shear_stiffness_times_step), dt);
    }
    energy.shear_strain += rolling_energy(state, base);
    return energy;
}

} // namespace listric::dem
