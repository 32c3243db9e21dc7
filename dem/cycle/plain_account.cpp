#include "dem/cycle/plain_account.hpp"

#include "dem/columns.hpp"
#include "dem/law.hpp"

#include <algorithm>
#include <optional>

namespace listric::dem {

struct PlainAccount::BaseContact {
    const Surface& surface;
    double conveyor; ///< of the surface there, in units of the extension speed
    const BaseContactDisc& disc;
    const ContactParameters& parameters;
    std::optional<BaseContactMotion> motion; ///< none where the surface has ended
    Point node_velocity;                     ///< of the base's nodes there, m/s; 0 if it is rigid
    BaseContactForce force;                  ///< on the disc
    double shear_before, shear_after;        ///< shear force, N
    double radius_rate;                      ///< of the disc, m/s
};

PlainAccount::PlainAccount(State& state, const RigidBase& base)
    : state_(state), base_(base),
      now_(base_instant(base.motion.at(state.clock.time(), state.clock.travel),
                        state.clock.extension.m)),
      d_(disc_columns(state)), c_(contact_columns(state)), b_(base_contact_columns(state)),
      nodes_(base_node_columns(state)), radii_(state), of_nodes_(state.base_nodes.rows()) {}

void PlainAccount::enter(const BaseContact& contact) {
    const auto& [surface, conveyor, disc, p, motion, node_velocity, force, before, after,
                 radius_rate] = contact;
    const Clock& clock = state_.clock;
    const Motion& base = base_.motion;
    const double dt = clock.time_step, time = clock.time();
    const double speed = base.speed_at(time), next_speed = base.speed_at(time + dt);
    const auto stiffness_times_step = static_cast<double>(p.shear_stiffness_times_step);
    if (!motion) {
        flows_.friction += slip_loss(before, before, after, stiffness_times_step, dt);
        return;
    }
    const double trial = before - stiffness_times_step * motion->slip_rate;
    flows_.friction += slip_loss(before, trial, after, stiffness_times_step, dt);

    // The step before this force and the one after it. Slip knows the speed of the base a step
    // later.
    const double last_speed = clock.cycle == 0 ? 0.0 : base.speed_at(time - dt);
    const Point n = motion->foot.normal, moves = surface.translation;
    const double now = disc.radius - motion->foot.distance;
    const double overlap_before =
        now + dt * ((disc.vx - node_velocity.x - last_speed * moves.x) * n.x +
                    (disc.vy - node_velocity.y - last_speed * moves.y) * n.y - radius_rate);
    flows_.radii += (force.x * n.x + force.y * n.y) * radius_rate * dt;
    flows_.stepping +=
        normal_loss(std::max(overlap_before, 0.0), overlap_before, std::max(now, 0.0), now, p);
    flows_.boundary_work += 0.5 * dt *
                            ((last_speed + speed) * (force.x * moves.x + force.y * moves.y) +
                             (speed + next_speed) * conveyor * (force.x * n.y - force.y * n.x));
    if (surface.stretched_length > 0.0) {
        const double share = surface.stretch, extension = clock.extension.m;
        const double length = surface.stretched_length + share * extension;
        const double from = surface.stretched_from + moves.x * extension;
        flows_.boundary_work +=
            0.5 * dt * force.x *
            (speed * share * (disc.x - from) / length +
             next_speed * share * (disc.x + dt * disc.vx - (from + moves.x * dt * speed)) /
                 (length + share * dt * speed));
    }
}

const Surface& PlainAccount::surface_of(std::size_t k) const {
    return base_.surfaces[static_cast<std::size_t>(b_.surface[k])];
}

double PlainAccount::radius_rate_of(std::size_t k) const {
    return radii_[static_cast<std::size_t>(b_.disc[k])];
}

void PlainAccount::enter_base_contact(std::size_t k, const BaseContactDisc& disc,
                                      const ContactParameters& p, double shear_before,
                                      const BaseContactForce& force) {
    const Surface& surface = surface_of(k);
    const auto motion = base_contact_motion(surface, now_, disc);
    const double conveyor =
        motion ? conveyor_at(surface, now_, x_of_foot(motion->foot, disc)) : 0.0;
    enter({surface, conveyor, disc, p, motion, Point{}, force, shear_before, b_.shear_force[k],
           radius_rate_of(k)});
}

void PlainAccount::enter_node_contact(std::size_t k, const BaseContactDisc& disc,
                                      const ContactParameters& p, double shear_before,
                                      const NodeContactForce& on_nodes) {
    const Surface& surface = surface_of(k);
    // The contact's place has been found: to look again changes nothing.
    double place = state_.base_contacts.get(columns::place)[k];
    const NodeContactMotion at = node_contact_motion(surface, nodes_, now_.extension, disc, place);
    enter({surface, conveyor_at(surface, now_, at.x), disc, p,
           surface_motion(surface, at, now_, disc), at.velocity, on_nodes.force, shear_before,
           b_.shear_force[k], radius_rate_of(k)});
    if (surface.follows == Follows::breakaway) {
        of_nodes_[0].x += on_nodes.force.x;
        of_nodes_[0].y += on_nodes.force.y;
    } else {
        for (std::size_t m = 0; m <= static_cast<std::size_t>(surface.degree); ++m) {
            of_nodes_[on_nodes.node + m].x += on_nodes.weight[m] * on_nodes.force.x;
            of_nodes_[on_nodes.node + m].y += on_nodes.weight[m] * on_nodes.force.y;
        }
    }
}

void PlainAccount::enter_half_step() {
    double power = 0.0;
    for (std::size_t k = 0; k < of_nodes_.size(); ++k)
        power += of_nodes_[k].x * nodes_.vx[k] + of_nodes_[k].y * nodes_.vy[k];
    flows_.base_work += 0.5 * state_.clock.time_step * power;
}

} // namespace listric::dem
