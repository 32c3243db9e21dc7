#include "dem/cycle/plain_cycle.hpp"

#include "dem/base/contact.hpp"
#include "dem/base/place.hpp"
#include "dem/base/rest.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/cycle/plain_account.hpp"
#include "dem/cycle/plain_pair.hpp"
#include "dem/cycle/undamped_motion.hpp"
#include "dem/law.hpp"
#include "dem/numbers/order_free.hpp"
#include "dem/pushes.hpp"
#include "dem/radius_rates.hpp"
#include "dem/rolling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace listric::dem {

namespace {

/// Forces of the base on the discs, which also starts their sum with the pushes.
template <class Rolling, class Account>
void base_forces(State& state, const RigidBase& base, std::span<Force> force, Account& account) {
    const DiscColumns d = disc_columns(state);
    const BaseContactColumns c = base_contact_columns(state);
    std::ranges::fill(force, Force{0.0, 0.0, 0.0});
    if (const Pushes pushes(state); pushes.any())
        for (std::size_t i = 0; i < force.size(); ++i) {
            force[i].x += pushes[i].x;
            force[i].y += pushes[i].y;
        }
    const BaseInstant now = base_instant(base, state.clock);
    const BaseNodeColumns nodes = base_node_columns(state);
    const bool deforms = !nodes.x.empty();
    const std::span<double> rolling = rolling_moments(state.base_contacts);
    const auto places = deforms ? state.base_contacts.get(columns::place) : std::span<double>();
    for (std::size_t k = 0; k < c.disc.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.disc[k]);
        const Surface& surface = base.surfaces[static_cast<std::size_t>(c.surface[k])];
        const BaseContactDisc disc{d.x[i], d.y[i], d.vx[i], d.vy[i], d.spin[i], d.radius[i]};
        const ContactParameters p = base_contact_parameters(
            base.material, state.materials[d.material[i]], state.clock.time_step);
        const double shear_before = c.shear_force[k];
        Rolling moment{};
        if constexpr (rolls<Rolling>)
            moment = rolling[k];
        BaseContactForce f;
        if (deforms && surface.follows != Follows::nothing) {
            const NodeContactForce on_nodes = node_contact_force(
                surface, nodes, now, disc, p, c.shear_force[k], places[k], moment);
            add_load(nodes, on_nodes, surface.degree);
            f = on_nodes.force;
            account.enter_node_contact(k, disc, p, shear_before, on_nodes);
        } else {
            f = base_contact_force(surface, now, disc, p, c.shear_force[k], moment);
            account.enter_base_contact(k, disc, p, shear_before, f);
        }
        if constexpr (rolls<Rolling>) {
            account.enter_rolling(rolling[k], moment, disc.spin, disc.radius, p);
            rolling[k] = moment;
        }
        force[i].x += f.x;
        force[i].y += f.y;
        force[i].moment += f.moment;
    }
}

/// Updates the moment of contact k against rolling, N m, which is on the second disc.
template <class Account>
void resist_rolling(const DiscColumns& d, const ContactColumns& c, std::size_t k, double normal,
                    const ContactParameters& p, double& moment, Account& account) {
    const auto i = static_cast<std::size_t>(c.first[k]), j = static_cast<std::size_t>(c.second[k]);
    const double lever = d.radius[i] * d.radius[j] / (d.radius[i] + d.radius[j]);
    const double roll_rate = d.spin[j] - d.spin[i];
    const double before = moment;
    moment = rolling_moment(before, roll_rate, lever, c.bonded[k] ? 0.0 : normal, p);
    account.enter_rolling(before, moment, roll_rate, lever, p);
}

/// Forces of discs that touch or are bonded on each other.
template <class Rolling, class Account>
void contact_forces(State& state, const PairParameters& pairs, std::span<Force> force,
                    Account& account) {
    const DiscColumns d = disc_columns(state);
    const ContactColumns c = contact_columns(state);
    const std::span<double> rolling = rolling_moments(state.contacts);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        const double reach = d.radius[i] + d.radius[j];
        const double square = dx * dx + dy * dy;
        const double shear_before = c.shear_force[k];
        const bool was_bonded = c.bonded[k];
        double normal = 0.0;
        const ContactParameters& p = pairs(d.material[i], d.material[j]);
        if (square >= reach * reach && !was_bonded) {
            c.shear_force[k] = 0.0;
            if constexpr (rolls<Rolling>)
                resist_rolling(d, c, k, 0.0, p, rolling[k], account);
        } else {
            const Pair pair = pair_of(d, i, j, dx, dy, square);
            normal = contact_force(pair.overlap, pair.slip_rate, p, c.tensile_strength[k],
                                   c.shear_strength[k], c.shear_force[k], c.bonded[k]);
            const double shear = c.shear_force[k];
            const double fx = normal * pair.nx - shear * pair.ny;
            const double fy = normal * pair.ny + shear * pair.nx;
            double moment_i = -(pair.arm_i * shear), moment_j = -(pair.arm_j * shear);
            if constexpr (rolls<Rolling>) {
                resist_rolling(d, c, k, normal, p, rolling[k], account);
                moment_i -= rolling[k];
                moment_j += rolling[k];
            }
            force[i].x -= fx;
            force[i].y -= fy;
            force[i].moment += moment_i;
            force[j].x += fx;
            force[j].y += fy;
            force[j].moment += moment_j;
        }
        account.enter_contact(k, p, was_bonded, shear_before, normal);
    }
}

/// Newton's law for every disc. Returns the largest component of a velocity, m/s.
template <class Account>
double move_discs(State& state, const CyclePhysics& physics, UndampedMotion undamped,
                  std::span<const Force> force, Account& account) {
    const DiscColumns d = disc_columns(state);
    const RadiusRates radii(state);
    const double dt = state.clock.time_step;
    double fastest = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double inertia = std::max(d.mass[i], state.inertial_mass_floor);
        const double acceleration_per_force = dt / inertia;
        const double radius = radii.of_inertia(i, d.radius[i]);
        const double spin_up = acceleration_per_force * (2.0 / (radius * radius));
        const Force all{force[i].x, force[i].y - d.mass[i] * physics.gravity, force[i].moment};
        const Point free = undamped(d, i);
        const Force net{damped(all.x, d.vx[i] - free.x, physics.damping),
                        damped(all.y, d.vy[i] - free.y, physics.damping),
                        damped(all.moment, d.spin[i], physics.damping)};
        const Force before{d.vx[i], d.vy[i], d.spin[i]};
        d.vx[i] += net.x * acceleration_per_force;
        d.vy[i] += net.y * acceleration_per_force;
        d.spin[i] += net.moment * spin_up;
        account.enter_motion(i, all, net, before);
        d.x[i] += d.vx[i] * dt;
        d.y[i] += d.vy[i] * dt;
        d.rotation[i] += d.spin[i] * dt;
        d.radius[i] += radii[i] * dt;
        undamped.learn(d, i);
        fastest = greater(fastest, greater(std::abs(d.vx[i]), std::abs(d.vy[i])));
    }
    return fastest;
}

/// One plain cycle. It is written to be read. Returns the largest component of a velocity, m/s.
template <class Account>
double cycle_plainly(State& state, const RigidBase& base, const CyclePhysics& physics,
                     const PairParameters& pairs, std::span<Force> force, BaseResponse* response,
                     Surroundings& around, Account&& account) {
    Clock& clock = state.clock;
    const MotionInstant motion = base.motion.at(clock.time(), clock.travel);
    if (resists_rolling(state)) {
        base_forces<double>(state, base, force, account);
        contact_forces<double>(state, pairs, force, account);
    } else {
        base_forces<FreeRolling>(state, base, force, account);
        contact_forces<FreeRolling>(state, pairs, force, account);
    }
    const Stretching thins = stretching(base, clock.extension.m, motion.speed);
    const double disc_speed = move_discs(
        state, physics, {state, physics, thins, stops(base.motion, clock.travel)}, force, account);
    account.enter_half_step();
    around.respond(state, clock, response);
    account.enter_half_step();
    const double fastest_node = move_nodes(base_node_columns(state), clock.time_step);
    const double fastest_wall = greatest_translation(base) * std::abs(motion.speed);
    clock.travel.m += motion.travel_speed * clock.time_step;
    clock.extension = base.motion.position(clock.travel);
    ++clock.cycle;
    return greater(around.after_cycle(state, disc_speed), greater(fastest_wall, fastest_node));
}

/// Adds the greatest speeds of cycles, m/s, to what is known of the displacements.
void enter_speeds(State& state, std::vector<double>& speeds, Surroundings& around) {
    around.agree_on(speeds);
    for (const double fastest : speeds) {
        state.window_speed = greater(state.window_speed, fastest);
        state.displacement_bound += std::numbers::sqrt2 * fastest * state.clock.time_step;
    }
    speeds.clear();
}

/// Keeps the neighbour lists good for the cycles up to the next check; false if that cannot be.
bool check_lists(State& state, const RigidBase& base, Surroundings& around) {
    if (is_measurement_due(state.displacement_bound, state.skin)) {
        state.displacement_bound = greatest_displacement(state, base);
        around.agree_on({&state.displacement_bound, 1});
        if (is_update_due(state.displacement_bound, state.skin) &&
            around.update_lists(state, base) == ListUpdate::runaway)
            return false;
    }
    state.check_interval = next_check_interval(state.check_interval, state.window_speed,
                                               state.clock.time_step, state.skin);
    state.window_speed = 0.0;
    return true;
}

} // namespace

std::int64_t advance_plainly(State& state, const RigidBase& base, const CyclePhysics& physics,
                             std::int64_t cycles, BaseResponse* response, EnergyFlows* total,
                             Surroundings& around) {
    std::vector<Force> force;
    std::vector<double> speeds; // of cycles since the last check
    const PairParameters pairs(state.materials, state.clock.time_step);
    std::int64_t done = 0;
    for (; done < cycles; ++done) {
        if (state.clock.cycle % state.check_interval == 0) {
            enter_speeds(state, speeds, around);
            if (!check_lists(state, base, around))
                return done;
        }
        force.resize(state.discs.rows()); // it may have changed with the lists
        const auto cycle = [&](auto&& account) {
            speeds.push_back(
                cycle_plainly(state, base, physics, pairs, force, response, around, account));
        };
        if (total) {
            PlainAccount account(state, base); // of one cycle, however calls are cut
            cycle(account);
            *total += account.flows();
        } else {
            cycle(NoAccount());
        }
    }
    enter_speeds(state, speeds, around);
    return done;
}

} // namespace listric::dem
