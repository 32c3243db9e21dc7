#pragma once

#include "dem/base/contact.hpp"
#include "dem/contacts/energy.hpp"
#include "dem/cycle/plain_pair.hpp"
#include "dem/radius_rates.hpp"
#include "dem/state.hpp"

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
    /// Enters those of a contact with a surface that deforms.
    void enter_node_contact(std::size_t k, const BaseContactDisc& disc, const ContactParameters& p,
                            double shear_before, const NodeContactForce& on_nodes);

    /// Enters what contact k loses as its shear force goes from `shear_before` to what it is.
    /// @param normal  force, N; 0 where the discs do not touch
    void enter_contact(std::size_t k, const ContactParameters& p, bool was_bonded,
                       double shear_before, double normal);

    /// Enters what damping takes from disc i, whose velocity and spin were `before`.
    /// @param all  forces but damping
    /// @param net  forces with damping
    void enter_motion(std::size_t i, const Force& all, const Force& net, const Force& before);

    /// Enters the work of the nodes' present velocities in half a step: they change in the middle.
    void enter_half_step();

    const EnergyFlows& flows() const { return flows_; }

private:
    struct BaseContact; ///< what a disc and a surface do to each other in the cycle
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
    template <class... Any> void enter_motion(Any&&...) {}
    void enter_half_step() {}
};

} // namespace listric::dem
