#include "coupling/elastic_base.hpp"

#include "coupling/base_memory.hpp"
#include "coupling/interface_loads.hpp"
#include "dem/law.hpp"
#include "dem/numbers/order_free.hpp"
#include "dem/pushes.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numeric>

namespace listric::coupling {

using namespace dem;

namespace {

using SteadyClock = std::chrono::steady_clock;

double norm(std::span<const double> v) {
    return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

/// Weight of discs per metre of length right of `from`, Pa. A disc across the line counts by the
/// part of its width.
double weight_per_length(const State& state, double from, double to, double gravity) {
    const ConstDiscColumns d = disc_columns(state);
    const Pushes pushes(state);
    double mass = 0.0, pushed = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double share =
            std::clamp((d.x[i] + d.radius[i] - from) / (2.0 * d.radius[i]), 0.0, 1.0);
        mass += d.mass[i] * share;
        pushed += pushes[i].y * share;
    }
    return (gravity * mass - pushed) / (to - from);
}

double mass(const Ledger& ledger) { return ledger.initial + ledger.deposited - ledger.removed; }

/// Mean loads on the nodes over some cycles with a base at rest, N.
std::vector<double> mean_loads(State& state, const RigidBase& base, const CyclePhysics& physics,
                               int cycles, const Execution& execution) {
    const BaseNodeColumns nodes = base_node_columns(state);
    std::ranges::fill(nodes.load_x, 0);
    std::ranges::fill(nodes.load_y, 0);
    advance(state, base, physics, cycles, execution);
    const double unit = load_unit / cycles;
    std::vector<double> mean;
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        mean.push_back(unit * static_cast<double>(nodes.load_x[k]));
        mean.push_back(unit * static_cast<double>(nodes.load_y[k]));
    }
    return mean;
}

[[noreturn]] void report_creep(double change, double moves, double drift) {
    throw NumericalFailure(
        "the hanging wall does not come to rest: its load on the base still changes by " +
        std::to_string(change) +
        " (allowed: 2e-5) in 2,000 cycles, which would move the "
        "base by " +
        std::to_string(moves) + " m (allowed: " + std::to_string(drift) +
        ") without any extension; elastic_base.elastic_thickness_m may be too small, or "
        "material.friction such that the packing creeps");
}

} // namespace

double node_stiffness(const Material& base, std::span<const Material> discs, double node_spacing,
                      double mean_radius) {
    double stiffness = 0.0;
    for (const Material& disc : discs)
        stiffness = std::max(
            stiffness, static_cast<double>(contact_parameters(base, disc, 1.0).normal_stiffness));
    return 3.0 * stiffness * std::max(1.0, node_spacing / (2.0 * mean_radius));
}

ElasticBase::ElasticBase(Interface interface, const CouplingParameters& parameters)
    : interface_(std::move(interface)), parameters_(parameters),
      modes_(find_modes(interface_.compliance, interface_.unknowns(),
                        static_cast<std::size_t>(parameters.modes))),
      modal_load_(modes_.count()), velocity_(interface_.unknowns()) {
    assert(parameters.interval > 0);
    interval = parameters.interval;
}

void ElasticBase::attach(State& state) const {
    add_base_nodes(state, interface_.x, interface_.y);
    for (const char* name : {"reference_load_x", "reference_load_y"})
        state.base_nodes.add<double>(name, "N", 0.0);
    set_virtual_pressure(state, 0.0);
    begin_window_sums(state, interface_.unknowns());
    add_mode_columns(state, modes_.count());
}

bool ElasticBase::fits(const State& state) const {
    constexpr double near = 1e-3; // m: round-off of a mesh that is made on another machine
    const auto same = [](double a, double b) { return std::abs(a - b) < near; };
    if (state.base_nodes.rows() != interface_.x.size() || mode_count(state) != modes_.count())
        return false;
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    return std::ranges::equal(nodes.x, interface_.x, same) &&
           std::ranges::equal(nodes.y, interface_.y, same);
}

void ElasticBase::settle(State& state, const RigidBase& base, const CyclePhysics& physics,
                         const Execution& execution,
                         const std::function<void(std::string_view, double)>& report,
                         double drift) const {
    constexpr int window = 2000, most = 100;
    constexpr double change_allowed = 2e-5;
    RigidBase held = base;
    held.motion = {};
    CyclePhysics still = physics;
    still.averaging_time = 0.0; // toward rest
    const Clock clock = state.clock;
    std::vector<double> before(interface_.unknowns(), 0.0), change(before.size()), mean;
    for (int n = 0;; ++n) {
        mean = mean_loads(state, held, still, window, execution);
        std::ranges::transform(mean, before, change.begin(), std::minus());
        const double relative = norm(change) / norm(mean);
        double moves = 0.0;
        for (const double u : displacement(change))
            moves = std::max(moves, std::abs(u));
        if (n > 0 && relative < change_allowed && moves < drift)
            break;
        if (n + 1 == most)
            report_creep(relative, moves, drift);
        before = mean;
        report("settling on the base", static_cast<double>(n) / most);
    }
    const BaseNodeColumns nodes = base_node_columns(state);
    const auto reference_x = state.base_nodes.get<double>("reference_load_x");
    const auto reference_y = state.base_nodes.get<double>("reference_load_y");
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        reference_x[k] = mean[2 * k];
        reference_y[k] = mean[2 * k + 1];
        nodes.load_x[k] = nodes.load_y[k] = 0;
    }
    if (const double flat = flat_start(); flat < parameters_.wall_x)
        set_virtual_pressure(
            state, weight_per_length(state, flat, parameters_.wall_x, parameters_.gravity));
    state.clock = clock;
}

/// From where on the detachment is as deep as it gets, as far as the hanging wall reaches, m.
double ElasticBase::flat_start() const {
    double flat = parameters_.wall_x;
    for (std::size_t k = interface_.x.size();
         k-- > 0 && interface_.y[k] < interface_.y.back() + 1.0;)
        flat = std::min(flat, interface_.x[k]);
    return flat;
}

std::vector<double> ElasticBase::displacement(std::span<const double> forces) const {
    assert(forces.size() == interface_.unknowns());
    std::vector<double> u(forces.size());
    add_rows(interface_.compliance, forces, u); // symmetric
    return u;
}

std::vector<double> ElasticBase::holding_forces(const State& state) const {
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    std::vector<double> u(interface_.unknowns());
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        u[2 * k] = nodes.ux[k];
        u[2 * k + 1] = nodes.uy[k];
    }
    return forces_for(u);
}

std::vector<double> ElasticBase::forces_for(std::span<const double> displacement) const {
    assert(displacement.size() == interface_.unknowns());
    std::vector<double> modal(modes_.count()), forces(displacement.size());
    add_rows(modes_.by_unknown, displacement, modal);
    for (std::size_t k = 0; k < modal.size(); ++k)
        modal[k] /= modes_.compliance[k];
    add_rows(modes_.by_mode, modal, forces);
    return forces;
}

void ElasticBase::take_compliance(std::vector<double> compliance) {
    assert(modes_.count() == interface_.unknowns());
    modes_ = find_modes(compliance, interface_.unknowns());
    interface_.compliance = std::move(compliance);
}

void ElasticBase::express(State& state) const {
    const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
    const auto in_turn = [](std::span<const double> x, std::span<const double> y) {
        std::vector<double> both;
        for (std::size_t k = 0; k < x.size(); ++k)
            both.insert(both.end(), {x[k], y[k]});
        return both;
    };
    const ModeColumns modes = mode_columns(state);
    add_rows(modes_.by_unknown, in_turn(nodes.ux, nodes.uy), modes.displacement);
    add_rows(modes_.by_unknown, in_turn(nodes.vx, nodes.vy), modes.velocity);
}

std::vector<double> ElasticBase::interface_forces(const State& state) const {
    std::vector<double> forces = holding_forces(state);
    std::ranges::transform(forces, loads_elsewhere(state, forces.size()), forces.begin(),
                           std::minus());
    return forces;
}

ElasticBase::DiscLoad ElasticBase::take_disc_load(State& state, double cycles,
                                                  double extension) const {
    assert(cycles > 0.0);
    const BaseNodeColumns nodes = base_node_columns(state);
    const auto reference_x = state.base_nodes.get<double>("reference_load_x");
    const auto reference_y = state.base_nodes.get<double>("reference_load_y");
    DiscLoad load{cycles, extension, std::vector<double>(interface_.unknowns())};
    const double unit = load_unit / cycles;
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        const double x = unit * static_cast<double>(nodes.load_x[k]);
        const double y = unit * static_cast<double>(nodes.load_y[k]);
        load.reaction -= y;
        load.forces[2 * k] = x - reference_x[k];
        load.forces[2 * k + 1] = y - reference_y[k];
        nodes.load_x[k] = nodes.load_y[k] = 0;
    }
    // The rock right of the wall, which has left room to the discs, or in net shortening has taken
    // some from them.
    const double pressure = virtual_pressure(state) * (extension < 0.0 ? -1.0 : 1.0);
    const auto [from, to] = std::minmax({parameters_.wall_x, parameters_.wall_x + extension});
    const std::vector<double> per_pascal = pressure_forces(interface_, from, to);
    for (std::size_t k = 0; k < per_pascal.size(); ++k)
        load.forces[2 * k + 1] += pressure * per_pascal[k];
    return load;
}

void ElasticBase::book(State& state, const DiscLoad& load) const {
    const PushSums pushes = push_sums(state);
    const double weight = parameters_.gravity * mass(state.ledger) - pushes.now;
    double net = 0.0;
    for (std::size_t k = 1; k < load.forces.size(); k += 2)
        net += load.forces[k];
    const double change = virtual_pressure(state) * load.extension +
                          parameters_.gravity * (state.ledger.removed - state.ledger.deposited) +
                          (pushes.now - pushes.start);
    const WindowSums sums = window_sums(state);
    sums.cycles += load.cycles;
    sums.reaction_error += load.cycles * (load.reaction / weight - 1.0);
    sums.net_load += load.cycles * net;
    sums.weight_change += load.cycles * change;

    const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
    const bool with_effects = has_footwall_loads(state);
    const InterfaceMeans means = interface_sums(state, with_effects);
    for (std::size_t k = 0; k < load.forces.size(); ++k) {
        means.force[k] += load.cycles * load.forces[k];
        means.displacement[k] += load.cycles * (k % 2 ? nodes.uy[k / 2] : nodes.ux[k / 2]);
    }
    if (!with_effects)
        return;
    std::vector<double> effects(load.forces.size(), 0.0);
    add_footwall_loads(state, effects);
    for (std::size_t k = 0; k < effects.size(); ++k)
        means.effects[k] += load.cycles * effects[k];
}

void ElasticBase::respond(State& state, const Clock& clock) {
    const auto start = SteadyClock::now();
    const double cycles = interval;
    DiscLoad discs = take_disc_load(state, cycles, clock.extension.m);
    book(state, discs);
    load_ = std::move(discs.forces);
    add_footwall_loads(state, load_);
    move_modes(state, cycles * clock.time_step);
    seconds += std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// Mean mass of the settled discs on a node, kg per metre. Modes are orthonormal, so that each
/// carries about as much.
double ElasticBase::carried_mass(const State& state) const {
    const auto weight = state.base_nodes.get<double>("reference_load_y");
    return -std::accumulate(weight.begin(), weight.end(), 0.0) /
           (parameters_.gravity * static_cast<double>(weight.size()));
}

/// Newton's law for every mode, with the mass that makes its step `step` stable whatever its
/// stiffness and that of the contacts on it. On soft springs it is the discs' mass that swings, too
/// slowly for their damping against their mean motion; a dashpot ends that, c = 2 zeta sqrt(k m). A
/// base that sinks steadily lags behind its load by 2 zeta sqrt(m / k) s. The dashpot's force is
/// taken at the step's end, which is stable for any c.
void ElasticBase::move_modes(State& state, double step) {
    const auto [displacement, velocity] = mode_columns(state);
    add_rows(modes_.by_unknown, load_, modal_load_);
    const double carried = carried_mass(state);
    for (std::size_t k = 0; k < displacement.size(); ++k) {
        const double stiffness = 1.0 / modes_.compliance[k];
        const double mass =
            parameters_.mass_factor * (stiffness + parameters_.contact_stiffness) * step * step;
        const double dashpot =
            2.0 * parameters_.swing_damping * std::sqrt(stiffness * (mass + carried));
        const double force = modal_load_[k] - stiffness * displacement[k] - dashpot * velocity[k];
        velocity[k] +=
            damped(force, velocity[k], parameters_.damping) / (mass + dashpot * step) * step;
        displacement[k] += velocity[k] * step;
    }
    add_rows(modes_.by_mode, velocity, velocity_);
    const BaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        nodes.vx[k] = velocity_[2 * k];
        nodes.vy[k] = velocity_[2 * k + 1];
    }
}

std::vector<double> ElasticBase::displace(State& state, std::span<const double> forces) const {
    assert(forces.size() == interface_.unknowns());
    std::vector<double> modal(modes_.count()), moved(forces.size());
    add_rows(modes_.by_unknown, forces, modal);
    const auto displacement = mode_columns(state).displacement;
    for (std::size_t k = 0; k < modal.size(); ++k) {
        modal[k] *= modes_.compliance[k];
        displacement[k] += modal[k];
    }
    add_rows(modes_.by_mode, modal, moved);
    const BaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        nodes.ux[k] += moved[2 * k];
        nodes.uy[k] += moved[2 * k + 1];
    }
    return moved;
}

WindowBalance ElasticBase::window(const State& state) const {
    const ConstWindowSums sums = window_sums(state);
    const double cycles = std::max(1.0, sums.cycles);
    return {sums.reaction_error / cycles, sums.net_load / cycles, sums.weight_change / cycles,
            sums.cycles};
}

void ElasticBase::end_window(State& state) const {
    if (window_sums(state).cycles > 0.0)
        keep_window_means(state);
    begin_window_sums(state, interface_.unknowns());
}

} // namespace listric::coupling
