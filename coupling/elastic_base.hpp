#pragma once

#include "coupling/interface.hpp"
#include "coupling/modes.hpp"
#include "dem/cycle/cycle.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace listric::coupling {

struct CouplingParameters {
    int interval = 5;           ///< cycles between updates of the base
    int modes = 0;              ///< softest modes that move; 0: all
    double mass_factor = 0.6;   ///< modal mass over (stiffness + contact stiffness) (interval dt)^2
    double damping = 0.7;       ///< local, of every mode
    double swing_damping = 0.1; ///< share of the critical damping of a mode that carries the discs
    double contact_stiffness = 0.0; ///< of the discs on a node, N/m: see node_stiffness()
    double gravity = 9.81;          ///< m/s^2
    double wall_x = 0.0; ///< of the right wall before extension, m; beyond, the load is virtual
};

/// Stiffness of the discs that rest on one node, N/m: three contacts' (two springs in series each)
/// times the discs that a node spans.
double node_stiffness(const dem::Material& base, std::span<const dem::Material> discs,
                      double node_spacing, double mean_radius);

/// Means of a window of extension, for the force balance.
struct WindowBalance {
    double reaction_error = 0.0; ///< mean of base reaction over the discs' weight, less 1
    double net_load = 0.0;       ///< upward, of the base, relative to the start, N/m
    double weight_change = 0.0;  ///< removed minus added weight, N/m
    double cycles = 0.0;
};

/// An elastic footwall under the discs, condensed to the detachment and loaded by the changes of
/// the discs' forces since the settled initial state. Its memory are the state's nodes and
/// `base_memory`, so that it can be made anew for a resumed state.
class ElasticBase final : public dem::BaseResponse {
public:
    ElasticBase(Interface interface, const CouplingParameters& parameters);

    const Interface& interface() const { return interface_; }
    const CouplingParameters& parameters() const { return parameters_; }
    const Modes& modes() const { return modes_; }

    /// Gives a state the nodes, at rest.
    void attach(dem::State& state) const;

    /// Whether a state that was attached to a base has this one's nodes, at their places before
    /// extension, and as many modes.
    bool fits(const dem::State& state) const;

    /// Settles the discs while the nodes are held and makes the mean forces of the last 2,000
    /// cycles the reference load. Settled is where these change by less than 2e-5 from one 2,000
    /// to the next, and would move the base by less than `drift` m. Throws NumericalFailure if that
    /// is not reached. The clock is as before.
    void settle(dem::State& state, const dem::RigidBase& base, const dem::CyclePhysics& physics,
                const dem::Execution& execution,
                const std::function<void(std::string_view, double)>& report,
                double drift = 0.3) const;

    void respond(dem::State& state, const dem::Clock& clock) override;

    /// Static displacement of the interface under forces on its unknowns.
    std::vector<double> displacement(std::span<const double> forces) const;

    /// Forces on the interface that hold it so.
    std::vector<double> forces_for(std::span<const double> displacement) const;

    /// Forces on the interface that hold its present displacement.
    std::vector<double> holding_forces(const dem::State& state) const;

    /// Forces on the interface, of discs and of what rests on it, that hold its present
    /// displacement together with the effects' loads elsewhere.
    std::vector<double> interface_forces(const dem::State& state) const;

    /// Takes another compliance of the same nodes. All modes must be kept: those of one compliance
    /// are not those of another. A state's need express().
    void take_compliance(std::vector<double> compliance);

    /// Gives the modes the place and the velocity that the nodes have.
    void express(dem::State& state) const;

    /// Moves modes and nodes by what forces on the interface's unknowns displace them, and returns
    /// the displacement of the nodes, x and y of each, m. Velocities stay.
    std::vector<double> displace(dem::State& state, std::span<const double> forces) const;

    /// Means of the window that has begun.
    WindowBalance window(const dem::State& state) const;

    /// Keeps the window's means as the last window's, if it had a cycle, and begins another.
    void end_window(dem::State& state) const;

    double seconds = 0.0; ///< wall time spent responding

private:
    /// Mean load of the discs on the base over some cycles.
    struct DiscLoad {
        double cycles = 0.0;
        double extension = 0.0;     ///< at their end, m
        std::vector<double> forces; ///< on the interface's unknowns, relative to the reference,
                                    ///< with those of the virtual load, N
        double reaction = 0.0;      ///< upward, of the base on the discs, N
    };

    /// Takes the load of the last cycles from the nodes, where it is summed, and sets it to zero
    /// there.
    DiscLoad take_disc_load(dem::State& state, double cycles, double extension) const;

    /// Adds a load of the discs, the effects' loads and the displacement to the window's sums.
    void book(dem::State& state, const DiscLoad& load) const;

    double flat_start() const;
    double carried_mass(const dem::State& state) const;
    void move_modes(dem::State& state, double step);

    Interface interface_;
    CouplingParameters parameters_;
    Modes modes_;
    std::vector<double> load_;                  ///< that moves the base: discs and effects
    std::vector<double> modal_load_, velocity_; // scratch
};

} // namespace listric::coupling
