#pragma once

#include "dem/contacts/energy.hpp"
#include "dem/event.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric::dem {

/// The account has no parameters: the table is the switch.
struct EnergyParameters {};

/// Totals of an account, J per metre of thickness, since extension began.
struct EnergyBalance {
    double boundary_work, gravity_work;
    std::optional<double> base_work; ///< of a base that deforms
    std::optional<double> push_work; ///< of pushes
    StoredEnergy stored;             ///< now
    double stored_change;            ///< of kinetic and strain energy
    double friction, damping, bond_breaking, stepping;
    double events;                                        ///< work of all events
    std::vector<std::pair<std::string, double>> by_event; ///< and of each

    double residual() const {
        return stored_change + friction + damping + bond_breaking + stepping - boundary_work -
               base_work.value_or(0.0) - push_work.value_or(0.0) - gravity_work - events;
    }
};

/// Keeps the account of energy. It is never due: the simulation books cycles and events into it as
/// they happen. The work of an event (radii, stiffnesses, masses and bonds that change, discs that
/// come and go) is the change of kinetic and strain energy over it; compaction does work in
/// the cycles, too.
///
/// Its memory has one row: initial, stored, potential, boundary_work, gravity_work, friction,
/// damping, bond_breaking, stepping, base_work of a base that deforms, push_work and push_potential
/// of discs that are pushed and, for each event, event_NAME.
class EnergyAccount final : public Observer {
public:
    /// @param events  names of those that change the state
    EnergyAccount(double gravity, bool base_deforms, std::span<const std::string> events);

    /// Starts the account with a state that has its contacts.
    void open(const State& state, const RigidBase& base);

    /// Account that cycles add to, and its place afterwards.
    EnergyFlows flows() const;
    void put(const EnergyFlows& flows);

    /// Before events: what gravity did in the cycles since the last booking.
    void book_cycles(const State& state, const RigidBase& base);

    /// After an event, once contacts have been searched.
    void book_event(const std::string& name, const State& state, const RigidBase& base);

    EnergyBalance balance(const State& state, const RigidBase& base) const;

    bool apply(State&, const RigidBase&) override { return false; }

private:
    double value(std::string_view name) const { return memory.get<double>(name)[0]; }
    double& value(std::string_view name) { return memory.get<double>(name)[0]; }

    void keep_push_potential(const StoredEnergy& now);

    double gravity_;
};

} // namespace listric::dem
