#include "dem/cycle/plain_cycle.hpp"

#include "dem/base/contact.hpp"
#include "dem/base/place.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/energy.hpp"
#include "dem/damping.hpp"
#include "dem/law.hpp"
#include "dem/order_free.hpp"
#include "dem/radius_rates.hpp"
#include "dem/ranks/links.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace listric::dem {

namespace {

struct Force {
    double x, y, moment; ///< N, N, N m
};

// The cycle is compiled with and without an account of energy.

struct Account {
    EnergyFlows flows;           ///< of a cycle
    std::vector<Point> of_nodes; ///< force of each node of the base on discs in it, N
};

/// What a disc and a surface of the base do to each other in a cycle.
struct BaseContactCycle {
    const Surface& surface;
    const BaseContactDisc& disc;
    const ContactParameters& parameters;
    std::optional<BaseContactMotion> motion; ///< none where the surface has ended
    Point node_velocity;                     ///< of the base's nodes there, m/s; 0 if it is rigid
    BaseContactForce force;                  ///< on the disc
    double shear_before, shear_after;        ///< shear force, N
    double radius_rate;                      ///< of the disc, m/s
};

/// Enters what a base contact loses in a cycle, and the work of the prescribed motion of base and
/// walls.
void enter_base_flows(const BaseContactCycle& contact, const Motion& base, const Clock& clock,
                      EnergyFlows& flows) {
    const auto& [surface, disc, p, motion, node_velocity, force, before, after, radius_rate] =
        contact;
    const double dt = clock.time_step, time = clock.time();
    const double speed = base.speed_at(time), next_speed = base.speed_at(time + dt);
    if (!motion) {
        flows.friction += slip_loss(before, before, after, p, dt);
        return;
    }
    const double trial =
        before - static_cast<double>(p.shear_stiffness_times_step) * motion->slip_rate;
    flows.friction += slip_loss(before, trial, after, p, dt);

    // The step before this force and the one after it. Slip knows the speed of the base a step
    // later.
    const double last_speed = clock.cycle == 0 ? 0.0 : base.speed_at(time - dt);
    const Point n = motion->foot.normal, moves = surface.translation;
    const double now = disc.radius - motion->foot.distance;
    const double overlap_before =
        now + dt * ((disc.vx - node_velocity.x - last_speed * moves.x) * n.x +
                    (disc.vy - node_velocity.y - last_speed * moves.y) * n.y - radius_rate);
    flows.radii += (force.x * n.x + force.y * n.y) * radius_rate * dt;
    flows.stepping +=
        normal_loss(std::max(overlap_before, 0.0), overlap_before, std::max(now, 0.0), now, p);
    flows.boundary_work +=
        0.5 * dt *
        ((last_speed + speed) * (force.x * moves.x + force.y * moves.y) +
         (speed + next_speed) * surface.conveyor * (force.x * n.y - force.y * n.x));
    if (surface.stretched_length > 0.0) {
        const double length = surface.stretched_length + clock.extension;
        flows.boundary_work += 0.5 * dt * force.x *
                               (speed * disc.x / length +
                                next_speed * (disc.x + dt * disc.vx) / (length + dt * speed));
    }
}

/// Work of the nodes' present velocities in half a step, J/m: they change in the middle of it.
double half_step_work(const BaseNodeColumns& nodes, std::span<const Point> of_nodes, double dt) {
    double power = 0.0;
    for (std::size_t k = 0; k < of_nodes.size(); ++k)
        power += of_nodes[k].x * nodes.vx[k] + of_nodes[k].y * nodes.vy[k];
    return 0.5 * dt * power;
}

/// Enters the force of a contact for the work of the nodes that it acts on.
void enter_node_force(const Surface& surface, const NodeContactForce& f, Account& account) {
    if (surface.follows == Follows::breakaway) {
        account.of_nodes[0].x += f.force.x;
        account.of_nodes[0].y += f.force.y;
    } else {
        for (std::size_t k = 0; k <= static_cast<std::size_t>(surface.degree); ++k) {
            account.of_nodes[f.node + k].x += f.weight[k] * f.force.x;
            account.of_nodes[f.node + k].y += f.weight[k] * f.force.y;
        }
    }
}

/// Forces of the base on the discs, which also starts their sum.
template <bool accounted>
void base_forces(State& state, const RigidBase& base, std::span<Force> force, Account* account) {
    const DiscColumns d = disc_columns(state);
    const BaseContactColumns c = base_contact_columns(state);
    [[maybe_unused]] const RadiusRates radii(state);
    std::ranges::fill(force, Force{0.0, 0.0, 0.0});
    const Clock& clock = state.clock;
    const BaseMoment moment{clock.extension, base.motion.speed_at(clock.time())};
    const BaseNodeColumns nodes = base_node_columns(state);
    const bool deforms = !nodes.x.empty();
    const auto places = deforms ? state.base_contacts.get<double>("place") : std::span<double>();
    for (std::size_t k = 0; k < c.disc.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.disc[k]);
        const Surface& surface = base.surfaces[static_cast<std::size_t>(c.surface[k])];
        const BaseContactDisc disc{d.x[i], d.y[i], d.vx[i], d.vy[i], d.spin[i], d.radius[i]};
        const ContactParameters p =
            base_contact_parameters(base.material, state.materials[d.material[i]], clock.time_step);
        const double before = c.shear_force[k];
        BaseContactForce f;
        if (deforms && surface.follows != Follows::nothing) {
            const NodeContactForce on_nodes =
                node_contact_force(surface, nodes, moment, disc, p, c.shear_force[k], places[k]);
            add_load(nodes, on_nodes, surface.degree);
            f = on_nodes.force;
            if constexpr (accounted) {
                double place = places[k]; // it has been found: to look again changes nothing
                const NodeContactMotion at =
                    node_contact_motion(surface, nodes, moment.extension, disc, place);
                enter_base_flows({surface, disc, p, surface_motion(surface, at, moment, disc),
                                  at.velocity, f, before, c.shear_force[k], radii[i]},
                                 base.motion, clock, account->flows);
                enter_node_force(surface, on_nodes, *account);
            }
        } else {
            f = base_contact_force(surface, moment, disc, p, c.shear_force[k]);
            if constexpr (accounted)
                enter_base_flows({surface, disc, p, base_contact_motion(surface, moment, disc),
                                  Point{}, f, before, c.shear_force[k], radii[i]},
                                 base.motion, clock, account->flows);
        }
        force[i].x += f.x;
        force[i].y += f.y;
        force[i].moment += f.moment;
    }
}

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

/// What contact k loses in a cycle in which its shear force goes from `before` to what it is.
/// `growth` is that of the two radii in a step, m.
void enter_losses(const DiscColumns& d, const ContactColumns& c, std::size_t k,
                  const ContactParameters& p, bool was_bonded, double before, double growth,
                  double time_step, EnergyFlows& flows) {
    const auto i = static_cast<std::size_t>(c.first[k]), j = static_cast<std::size_t>(c.second[k]);
    const double reach = d.radius[i] + d.radius[j];
    const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
    const double square = dx * dx + dy * dy;
    if (!c.bonded[k]) {
        const double dx_before = dx - (d.vx[j] - d.vx[i]) * time_step;
        const double dy_before = dy - (d.vy[j] - d.vy[i]) * time_step;
        const double square_before = dx_before * dx_before + dy_before * dy_before;
        const double reach_before = reach - growth;
        const bool pressed = square < reach * reach,
                   was_pressed = square_before < reach_before * reach_before;
        if (pressed != was_pressed || (was_bonded && !pressed)) {
            const double now = reach - std::sqrt(square);
            const double overlap_before = reach_before - std::sqrt(square_before);
            (was_bonded && !was_pressed ? flows.bond_breaking : flows.stepping) +=
                normal_loss(was_bonded ? overlap_before : std::max(overlap_before, 0.0),
                            overlap_before, std::max(now, 0.0), now, p);
        }
    }
    const double after = c.shear_force[k];
    if (before == 0.0 && after == 0.0)
        return;
    const double slip_rate = pair_of(d, i, j, dx, dy, square).slip_rate;
    const double trial = before - static_cast<double>(p.shear_stiffness_times_step) * slip_rate;
    (was_bonded && !c.bonded[k] ? flows.bond_breaking : flows.friction) +=
        slip_loss(before, trial, after, p, time_step);
}

template <bool accounted>
void contact_forces(State& state, const PairParameters& pairs, std::span<Force> force,
                    Account* account) {
    const DiscColumns d = disc_columns(state);
    const ContactColumns c = contact_columns(state);
    [[maybe_unused]] const RadiusRates radii(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        const double reach = d.radius[i] + d.radius[j];
        const double square = dx * dx + dy * dy;
        [[maybe_unused]] const double before = c.shear_force[k];
        [[maybe_unused]] const bool was_bonded = c.bonded[k];
        if (square >= reach * reach && !c.bonded[k]) {
            c.shear_force[k] = 0.0;
        } else {
            const Pair pair = pair_of(d, i, j, dx, dy, square);
            const double normal = contact_force(
                pair.overlap, pair.slip_rate, pairs(d.material[i], d.material[j]),
                c.tensile_strength[k], c.shear_strength[k], c.shear_force[k], c.bonded[k]);
            const double shear = c.shear_force[k];
            const double fx = normal * pair.nx - shear * pair.ny;
            const double fy = normal * pair.ny + shear * pair.nx;
            force[i].x -= fx;
            force[i].y -= fy;
            force[i].moment -= pair.arm_i * shear;
            force[j].x += fx;
            force[j].y += fy;
            force[j].moment -= pair.arm_j * shear;
            if constexpr (accounted)
                account->flows.radii += normal * (radii[i] + radii[j]) * state.clock.time_step;
        }
        if constexpr (accounted)
            enter_losses(d, c, k, pairs(d.material[i], d.material[j]), was_bonded, before,
                         (radii[i] + radii[j]) * state.clock.time_step, state.clock.time_step,
                         account->flows);
    }
}

/// The motion that damping leaves alone.
class UndampedMotion {
public:
    /// @param thins  rate in 1/s
    UndampedMotion(State& state, const CyclePhysics& physics, Stretching thins)
        : averages_(physics.averaging_time > 0.0), thins_(thins) {
        if (!averages_)
            return;
        mean_vx_ = state.discs.get<float>("mean_vx");
        mean_vy_ = state.discs.get<float>("mean_vy");
        if (state.clock.cycle % averaging_interval == 0)
            share_ = averaging_interval * state.clock.time_step / physics.averaging_time;
    }

    Point operator()(const DiscColumns& d, std::size_t i) const { // m/s
        if (averages_)
            return {mean_vx_[i], mean_vy_[i]};
        if (thins_.rate > 0.0)
            return {thins_.rate * d.x[i], -thins_.rate * (d.y[i] - thins_.floor)};
        return {0.0, 0.0};
    }

    /// Takes a sample of the disc's velocity.
    void learn(const DiscColumns& d, std::size_t i) {
        if (share_ == 0.0)
            return;
        const double vx = mean_vx_[i], vy = mean_vy_[i];
        mean_vx_[i] = static_cast<float>(vx + (d.vx[i] - vx) * share_);
        mean_vy_[i] = static_cast<float>(vy + (d.vy[i] - vy) * share_);
    }

private:
    bool averages_;
    Stretching thins_;
    std::span<float> mean_vx_, mean_vy_;
    double share_ = 0.0; ///< of the sample in the mean
};

/// Newton's law for every disc. Returns the largest component of a velocity, m/s, that of ghosts
/// left out.
template <bool accounted>
double move_discs(State& state, const CyclePhysics& physics, UndampedMotion undamped,
                  std::span<const Force> force, Account* account, const Links* links) {
    const DiscColumns d = disc_columns(state);
    const RadiusRates radii(state);
    const double dt = state.clock.time_step;
    double fastest = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double inertia = std::max(d.mass[i], state.inertial_mass_floor);
        const double acceleration_per_force = dt / inertia;
        const double radius = radii.of_inertia(i, d.radius[i]);
        const double spin_up = acceleration_per_force * (2.0 / (radius * radius));
        const double fy = force[i].y - d.mass[i] * physics.gravity;
        const Point free = undamped(d, i);
        const Force net{damped(force[i].x, d.vx[i] - free.x, physics.damping),
                        damped(fy, d.vy[i] - free.y, physics.damping),
                        damped(force[i].moment, d.spin[i], physics.damping)};
        const double vx = d.vx[i], vy = d.vy[i], spin = d.spin[i];
        d.vx[i] += net.x * acceleration_per_force;
        d.vy[i] += net.y * acceleration_per_force;
        d.spin[i] += net.moment * spin_up;
        if constexpr (accounted)
            account->flows.damping +=
                0.5 * dt *
                ((force[i].x - net.x) * (vx + d.vx[i]) + (fy - net.y) * (vy + d.vy[i]) +
                 (force[i].moment - net.moment) * (spin + d.spin[i]));
        d.x[i] += d.vx[i] * dt;
        d.y[i] += d.vy[i] * dt;
        d.rotation[i] += d.spin[i] * dt;
        d.radius[i] += radii[i] * dt;
        undamped.learn(d, i);
        if (links && !links->own()[i])
            continue;
        fastest = greater(fastest, greater(std::abs(d.vx[i]), std::abs(d.vy[i])));
    }
    return fastest;
}

/// Lets the nodes of a base that deforms answer and move. Returns the largest component of a
/// velocity, m/s.
double move_base(State& state, const Clock& clock, BaseResponse* response, Links* links) {
    respond_if_due(state, clock, response, links);
    return move_nodes(base_node_columns(state), clock.time_step);
}

/// Adds a cycle's greatest speed, m/s, to what is known of the displacements.
void enter_speed(State& state, double fastest) {
    state.window_speed = greater(state.window_speed, fastest);
    state.displacement_bound += std::numbers::sqrt2 * fastest * state.clock.time_step;
}

/// The same with those of all ranks.
void enter_speeds(State& state, Links& links) {
    links.share_speeds();
    for (const double fastest : links.speeds)
        enter_speed(state, fastest);
    links.speeds.clear();
}

void renew_ghosts(State& state, Links& links) {
    const DiscColumns d = disc_columns(state);
    links.send_ghosts([&](std::size_t i, double* to) {
        for (const double number : {d.x[i], d.y[i], d.vx[i], d.vy[i], d.spin[i]})
            *to++ = number;
    });
    links.receive_ghosts([&](std::size_t i, const double* from) {
        for (double* const number : {&d.x[i], &d.y[i], &d.vx[i], &d.vy[i], &d.spin[i]})
            *number = *from++;
    });
}

/// One plain cycle. It is written to be read.
template <bool accounted>
void cycle_plainly(State& state, const RigidBase& base, const CyclePhysics& physics,
                   const PairParameters& pairs, std::span<Force> force, BaseResponse* response,
                   Account* account, Links* links) {
    Clock& clock = state.clock;
    const double speed = base.motion.speed_at(clock.time());
    if constexpr (accounted)
        *account = {{}, std::vector<Point>(state.base_nodes.rows())};
    base_forces<accounted>(state, base, force, account);
    contact_forces<accounted>(state, pairs, force, account);
    Stretching thins = stretching(base, clock.extension);
    thins.rate *= speed;
    const double disc_speed =
        move_discs<accounted>(state, physics, {state, physics, thins}, force, account, links);
    if constexpr (accounted)
        account->flows.base_work +=
            half_step_work(base_node_columns(state), account->of_nodes, clock.time_step);
    const double base_speed =
        greater(greatest_translation(base) * speed, move_base(state, clock, response, links));
    const double fastest = greater(disc_speed, base_speed);
    if constexpr (accounted)
        account->flows.base_work +=
            half_step_work(base_node_columns(state), account->of_nodes, clock.time_step);
    if (links) {
        renew_ghosts(state, *links);
        links->speeds.push_back(fastest);
    } else {
        enter_speed(state, fastest);
    }
    clock.extension += speed * clock.time_step;
    ++clock.cycle;
}

/// The greatest displacement of a share's own discs, in all shares, and of surfaces, m.
double greatest_displacement(const State& state, const RigidBase& base, Links& links) {
    const ConstDiscColumns d = disc_columns(state);
    double square = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double dx = d.x[i] - d.searched_x[i], dy = d.y[i] - d.searched_y[i];
        if (links.own()[i])
            square = greater(square, dx * dx + dy * dy);
    }
    return greater(std::sqrt(links.greatest(square)),
                   surface_travel(state, base, state.clock.extension));
}

/// Keeps the lists good for the cycles up to the next look. False: see Links::update_lists().
bool look_for_neighbours(State& state, const RigidBase& base, Links* links) {
    if (links)
        enter_speeds(state, *links);
    if (is_check_due(state.displacement_bound, state.skin)) {
        state.displacement_bound =
            links ? greatest_displacement(state, base, *links) : greatest_displacement(state, base);
        if (!links)
            refuse_runaways(state);
        if (is_update_due(state.displacement_bound, state.skin)) {
            if (links && !links->update_lists(base))
                return false;
            if (!links)
                update_contacts(state, base);
        }
    }
    state.look_interval = next_look_interval(state.look_interval, state.window_speed,
                                             state.clock.time_step, state.skin);
    state.window_speed = 0.0;
    return true;
}

} // namespace

std::int64_t advance_plainly(State& state, const RigidBase& base, const CyclePhysics& physics,
                             std::int64_t cycles, BaseResponse* response, EnergyFlows* total,
                             Links* links) {
    std::vector<Force> force(state.discs.rows());
    const PairParameters pairs(state.materials, state.clock.time_step);
    std::int64_t done = 0;
    for (; done < cycles; ++done) {
        if (state.clock.cycle % state.look_interval == 0 &&
            !look_for_neighbours(state, base, links))
            return done;
        force.resize(state.discs.rows()); // ghosts come and go
        if (!total) {
            cycle_plainly<false>(state, base, physics, pairs, force, response, nullptr, links);
            continue;
        }
        // Sums of their own for every cycle, so that it does not matter how calls are cut.
        Account account;
        cycle_plainly<true>(state, base, physics, pairs, force, response, &account, links);
        *total += account.flows;
    }
    if (links)
        enter_speeds(state, *links);
    return done;
}

} // namespace listric::dem
