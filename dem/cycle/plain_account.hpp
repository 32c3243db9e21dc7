#pragma once

#include "dem/base/contact.hpp"
#include "dem/contacts/energy.hpp"
#include "dem/cycle/plain_pair.hpp"
#include "dem/radius_rates.hpp"
#include "dem/state.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace listric::dem {

/// The account of energy of one plain cycle, which tells it of each force and motion as it computes
/// them.
class PlainAccount {
public:
    /// Both must outlive it.
    PlainAccount(State& state, const RigidBase& base);

    /// Enters what base contact k loses, and the work of the prescribed motion of base and walls.
    void enter_base_contact(std::size_t k, const BaseContactDisc& disc, const ContactParameters& p,
                            double shear_before, const BaseContactForce& force);
    /// Enters what a contact with a surface that deforms loses.
    void enter_node_contact(std::size_t k, const BaseContactDisc& disc, const ContactParameters& p,
                            double shear_before, const NodeContactForce& on_nodes);

    /// Enters what contact k loses as its shear force goes from `shear_before` to what it is.
    /// @param normal  force, N; 0 where the discs do not touch
    void enter_contact(std::size_t k, const ContactParameters& p, bool was_bonded,
                       double shear_before, double normal);

    /// Enters what a contact loses as its moment against rolling goes from `before` to `after`.
    void enter_rolling(double before, double after, double roll_rate, double lever,
                       const ContactParameters& p) {
        const double stiffness_times_step = rolling_stiffness_times_step(p, lever);
        flows_.friction += slip_loss(before, before - stiffness_times_step * roll_rate, after,
                                     stiffness_times_step, state_.clock.time_step);
    }

    /// Enters what damping takes from disc i, whose velocity and spin were `before`.
    /// @param all  forces but damping
    /// @param net  forces with damping
    void enter_motion(std::size_t i, const Force& all, const Force& net, const Force& before);

    /// Enters the work of the nodes' present velocities in half a step: they change in the middle.
    void enter_half_step();

    const EnergyFlows& flows() const { return flows_; }

private:
    struct BaseContact; ///< forces between a disc and a surface in the cycle
    void enter(const BaseContact& contact);
    const Surface& surface_of(std::size_t k) const;
    double radius_rate_of(std::size_t k) const;

    State& state_;
    const RigidBase& base_;
    BaseInstant now_;
    DiscColumns d_;
    ContactColumns c_;
    BaseContactColumns b_;
    BaseNodeColumns nodes_;
    RadiusRates radii_;
    EnergyFlows flows_;           ///< of the cycle
    std::vector<Point> of_nodes_; ///< force of each node of the base on discs, N
};

/// Stands for an account where none is kept, at no cost.
struct NoAccount {
    template <class... Any> void enter_base_contact(Any&&...) {}
    template <class... Any> void enter_node_contact(Any&&...) {}
    template <class... Any> void enter_contact(Any&&...) {}
    template <class... Any> void enter_rolling(Any&&...) {}
    template <class... Any> void enter_motion(Any&&...) {}
    void enter_half_step() {}
};

inline void PlainAccount::enter_contact(std::size_t k, const ContactParameters& p, bool was_bonded,
                                        double shear_before, double normal) {
    const auto i = static_cast<std::size_t>(c_.first[k]),
               j = static_cast<std::size_t>(c_.second[k]);
    const double time_step = state_.clock.time_step;
    flows_.radii += normal * (radii_[i] + radii_[j]) * time_step;
    const double reach = d_.radius[i] + d_.radius[j];
    const double growth = (radii_[i] + radii_[j]) * time_step; // of the reach, m
    const double dx = d_.x[j] - d_.x[i], dy = d_.y[j] - d_.y[i];
    const double square = dx * dx + dy * dy;
    if (!c_.bonded[k]) {
        const double dx_before = dx - (d_.vx[j] - d_.vx[i]) * time_step;
        const double dy_before = dy - (d_.vy[j] - d_.vy[i]) * time_step;
        const double square_before = dx_before * dx_before + dy_before * dy_before;
        const double reach_before = reach - growth;
        const bool pressed = square < reach * reach,
                   was_pressed = square_before < reach_before * reach_before;
        if (pressed != was_pressed || (was_bonded && !pressed)) {
            const double now = reach - std::sqrt(square);
            const double overlap_before = reach_before - std::sqrt(square_before);
            (was_bonded && !was_pressed ? flows_.bond_breaking : flows_.stepping) +=
                normal_loss(was_bonded ? overlap_before : std::max(overlap_before, 0.0),
                            overlap_before, std::max(now, 0.0), now, p);
        }
    }
    const double after = c_.shear_force[k];
    if (shear_before == 0.0 && after == 0.0)
        return;
    const double slip_rate = pair_of(d_, i, j, dx, dy, square).slip_rate;
    const auto stiffness_times_step = static_cast<double>(p.shear_stiffness_times_step);
    const double trial = shear_before - stiffness_times_step * slip_rate;
    (was_bonded && !c_.bonded[k] ? flows_.bond_breaking : flows_.friction) +=
        slip_loss(shear_before, trial, after, stiffness_times_step, time_step);
}

inline void PlainAccount::enter_motion(std::size_t i, const Force& all, const Force& net,
                                       const Force& before) {
    flows_.damping +=
        0.5 * state_.clock.time_step *
        ((all.x - net.x) * (before.x + d_.vx[i]) + (all.y - net.y) * (before.y + d_.vy[i]) +
         (all.moment - net.moment) * (before.moment + d_.spin[i]));
}

} // namespace listric::dem
