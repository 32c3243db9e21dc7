#include "coupling/elastic_base.hpp"

#include "coupling/footwall_loads.hpp"
#include "dem/damping.hpp"
#include "dem/law.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

namespace listric::coupling {

using namespace dem;

namespace {

using SteadyClock = std::chrono::steady_clock;

double norm(std::span<const double> v) {
    return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

double largest(std::span<const double> v) {
    double most = 0.0;
    for (const double value : v)
        if (!(std::abs(value) <= most))
            most = std::abs(value);
    return most;
}

/// Weight of discs per metre of length right of `from`, Pa. A disc across the line counts by the
/// part of its width.
double weight_per_length(const State& state, double from, double to, double gravity) {
    const ConstDiscColumns d = disc_columns(state);
    double mass = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        mass +=
            d.mass[i] * std::clamp((d.x[i] + d.radius[i] - from) / (2.0 * d.radius[i]), 0.0, 1.0);
    return gravity * mass / (to - from);
}

double mass(const Ledger& ledger) { return ledger.initial + ledger.deposited - ledger.removed; }

Table one_row(std::initializer_list<std::pair<const char*, const char*>> columns) {
    Table table;
    table.resize(1);
    for (const auto& [name, unit] : columns)
        table.add<double>(name, unit, 0.0);
    return table;
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
                        // Nodes that move one by one need all stiffness.
                        parameters.scheme == CouplingScheme::modal
                            ? static_cast<std::size_t>(parameters.modes)
                            : 0)),
      load_(interface_.unknowns()), modal_load_(modes_.count()), modal_velocity_(modes_.count()),
      velocity_(interface_.unknowns()) {
    interval = parameters.interval;
    if (parameters.scheme != CouplingScheme::lumped)
        return;
    const std::size_t n = modes_.unknowns, kept = modes_.count();
    std::vector<double> scaled(kept), row(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < kept; ++k)
            scaled[k] = modes_.by_unknown[i * kept + k] / modes_.compliance[k];
        add_rows(modes_.by_mode, scaled, row);
        stiffness_.insert(stiffness_.end(), row.begin(), row.end());
        double sum = 0.0;
        for (const double s : row)
            sum += std::abs(s);
        lumped_stiffness_.push_back(sum);
    }
}

double ElasticBase::staggered_growth() const {
    return modes_.compliance.front() * parameters_.contact_stiffness / 3.0;
}

void ElasticBase::attach(State& state) const {
    add_base_nodes(state, interface_.x, interface_.y);
    for (const char* name : {"reference_load_x", "reference_load_y"})
        state.base_nodes.add<double>(name, "N", 0.0);
    state.base_memory["reference"] = one_row({{"virtual_pressure", "Pa"}});
    begin_window(state);
    Table& modes = state.base_memory["modes"];
    modes.resize(modes_.count());
    modes.add<double>("displacement", "m", 0.0);
    modes.add<double>("velocity", "m/s", 0.0);
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
    const BaseNodeColumns nodes = base_node_columns(state);
    std::vector<double> before(interface_.unknowns()), mean(before.size()), change(before.size());
    double relative = 0.0, moves = 0.0;
    for (int n = 0; n < most; ++n) {
        std::ranges::fill(nodes.load_x, 0.0);
        std::ranges::fill(nodes.load_y, 0.0);
        advance(state, held, still, window, execution);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            mean[2 * k] = nodes.load_x[k] / window;
            mean[2 * k + 1] = nodes.load_y[k] / window;
        }
        std::ranges::transform(mean, before, change.begin(), std::minus());
        relative = norm(change) / norm(mean);
        moves = 0.0;
        for (const double u : displacement(change))
            moves = std::max(moves, std::abs(u));
        if (n > 0 && relative < change_allowed && moves < drift)
            break;
        if (n + 1 == most)
            throw NumericalFailure(
                "the hanging wall does not come to rest: its load on the base still changes by " +
                std::to_string(relative) +
                " (allowed: 2e-5) in 2,000 cycles, which would move the "
                "base by " +
                std::to_string(moves) + " m (allowed: " + std::to_string(drift) +
                ") without any extension; elastic_base.elastic_thickness_m may be too small, or "
                "material.friction such that the packing creeps");
        before = mean;
        report("settling on the base", static_cast<double>(n) / most);
    }
    const auto reference_x = state.base_nodes.get<double>("reference_load_x");
    const auto reference_y = state.base_nodes.get<double>("reference_load_y");
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        reference_x[k] = mean[2 * k];
        reference_y[k] = mean[2 * k + 1];
        nodes.load_x[k] = nodes.load_y[k] = 0.0;
    }
    // The detachment is as deep as it gets over the last part of the hanging wall.
    double flat = parameters_.wall_x;
    for (std::size_t k = interface_.x.size();
         k-- > 0 && interface_.y[k] < interface_.y.back() + 1.0;)
        flat = std::min(flat, interface_.x[k]);
    if (flat < parameters_.wall_x)
        state.base_memory["reference"].get<double>("virtual_pressure")[0] =
            weight_per_length(state, flat, parameters_.wall_x, parameters_.gravity);
    state.clock = clock;
}

std::vector<double> ElasticBase::displacement(std::span<const double> forces) const {
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
    std::vector<double> modal(modes_.count()), forces(displacement.size());
    add_rows(modes_.by_unknown, displacement, modal);
    for (std::size_t k = 0; k < modal.size(); ++k)
        modal[k] /= modes_.compliance[k];
    add_rows(modes_.by_mode, modal, forces);
    return forces;
}

/// Takes the mean loads of the last cycles from the nodes, less the reference and with what is
/// virtual. Returns the upward reaction, N.
double ElasticBase::collect(State& state, double cycles, double extension) {
    const BaseNodeColumns nodes = base_node_columns(state);
    const auto reference_x = state.base_nodes.get<double>("reference_load_x");
    const auto reference_y = state.base_nodes.get<double>("reference_load_y");
    const double pressure = state.base_memory["reference"].get<double>("virtual_pressure")[0];
    double reaction = 0.0;
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        reaction -= nodes.load_y[k] / cycles;
        load_[2 * k] = nodes.load_x[k] / cycles - reference_x[k];
        load_[2 * k + 1] = nodes.load_y[k] / cycles - reference_y[k];
        nodes.load_x[k] = nodes.load_y[k] = 0.0;
    }
    // The rock right of the wall, which has left room to the discs.
    const std::vector<double> left =
        pressure_forces(interface_, parameters_.wall_x, parameters_.wall_x + extension);
    for (std::size_t k = 0; k < left.size(); ++k)
        load_[2 * k + 1] += pressure * left[k];
    return reaction;
}

/// Adds the loads and the displacement to the window's means, then the loads of the effects.
void ElasticBase::book(State& state, double cycles, double extension, double reaction) {
    const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
    const double pressure = state.base_memory["reference"].get<double>("virtual_pressure")[0];
    Table& sums = state.base_memory["window"];
    const double weight = parameters_.gravity * mass(state.ledger);
    double net = 0.0;
    for (std::size_t k = 1; k < load_.size(); k += 2)
        net += load_[k];
    const double change = pressure * extension +
                          parameters_.gravity * (state.ledger.removed - state.ledger.deposited);
    sums.get<double>("cycles")[0] += cycles;
    sums.get<double>("reaction_error")[0] += cycles * (reaction / weight - 1.0);
    sums.get<double>("net_load")[0] += cycles * net;
    sums.get<double>("weight_change")[0] += cycles * change;

    Table& means = state.base_memory["window_means"];
    const auto force = means.get<double>("force"), displacement = means.get<double>("displacement");
    for (std::size_t k = 0; k < load_.size(); ++k) {
        force[k] += cycles * load_[k];
        displacement[k] += cycles * (k % 2 ? nodes.uy[k / 2] : nodes.ux[k / 2]);
    }

    add_footwall_loads(state, load_);
    if (has_footwall_loads(state)) {
        const auto effects = means.add<double>("effects", "N", 0.0);
        std::vector<double> loads(load_.size(), 0.0);
        add_footwall_loads(state, loads);
        for (std::size_t k = 0; k < loads.size(); ++k)
            effects[k] += cycles * loads[k];
    }
}

void ElasticBase::respond(State& state, const Clock& clock) {
    const auto start = SteadyClock::now();
    const double cycles = interval;
    book(state, cycles, clock.extension, collect(state, cycles, clock.extension));
    const double step = cycles * clock.time_step;
    switch (parameters_.scheme) {
    case CouplingScheme::modal:
        move_modes(state, step);
        break;
    case CouplingScheme::lumped:
        move_lumped(state, step);
        break;
    case CouplingScheme::staggered:
        move_staggered(state, step);
        break;
    case CouplingScheme::strong: // see advance_iterated()
        break;
    }
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
    Table& memory = state.base_memory["modes"];
    const auto displacement = memory.get<double>("displacement");
    const auto velocity = memory.get<double>("velocity");
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

/// The same for every node, whose mass its row of the stiffness bounds.
void ElasticBase::move_lumped(State& state, double step) {
    const BaseNodeColumns nodes = base_node_columns(state);
    std::vector<double> u(modes_.unknowns);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        u[2 * k] = nodes.ux[k];
        u[2 * k + 1] = nodes.uy[k];
    }
    add_rows(stiffness_, u, velocity_); // symmetric
    const auto accelerate = [&](double& v, std::size_t i) {
        const double mass = parameters_.mass_factor *
                            (lumped_stiffness_[i] + parameters_.contact_stiffness) * step * step;
        v += damped(load_[i] - velocity_[i], v, parameters_.damping) / mass * step;
    };
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        accelerate(nodes.vx[k], 2 * k);
        accelerate(nodes.vy[k], 2 * k + 1);
    }
}

void ElasticBase::move_staggered(State& state, double step) {
    const std::vector<double> u = displacement(load_);
    const BaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        nodes.vx[k] = (u[2 * k] - nodes.ux[k]) / step;
        nodes.vy[k] = (u[2 * k + 1] - nodes.uy[k]) / step;
    }
}

double ElasticBase::advance_iterated(State& state, const RigidBase& base,
                                     const CyclePhysics& physics, std::int64_t cycles,
                                     const Execution& execution) {
    constexpr int most = 24, patience = 8;
    constexpr double allowed = 1e-3;                 // of the displacement
    const double noticed = 1e-4 * state.mean_radius; // m
    const double tolerable = 10.0 * noticed;         // where contacts that open and close hide it
    const std::size_t n = interface_.unknowns();
    Execution how = execution;
    EnergyFlows flows;
    double computed = 0.0, windows = 0.0;
    // What a residual load moves: (S + K)^-1, K at first that of all contacts, then as found.
    // (Broyden 1965, the good update)
    std::vector<double> at_first(n * n), scaled(n), row(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < n; ++k)
            scaled[k] = modes_.by_unknown[i * n + k] /
                        (1.0 / modes_.compliance[k] + parameters_.contact_stiffness / 3.0);
        add_rows(modes_.by_mode, scaled, row);
        std::ranges::copy(row, at_first.begin() + static_cast<std::ptrdiff_t>(i * n));
    }
    std::vector<double> gives = at_first;
    const auto times = [&](std::span<const double> v, bool transposed) {
        std::vector<double> result(n, 0.0);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < n; ++k)
                result[transposed ? k : i] += gives[i * n + k] * v[transposed ? i : k];
        return result;
    };
    while (cycles > 0) {
        const std::int64_t window = std::min(cycles, interval - state.clock.cycle % interval);
        const double time = static_cast<double>(window) * state.clock.time_step;
        const State start = state;
        std::vector<double> velocity(n), best(n), before, step;
        double best_off = std::numeric_limits<double>::infinity();
        const ConstBaseNodeColumns first = base_node_columns(start);
        for (std::size_t k = 0; k < first.x.size(); ++k) {
            velocity[2 * k] = first.vx[k];
            velocity[2 * k + 1] = first.vy[k];
        }
        double reaction = 0.0;
        for (int n_computed = 1;; ++n_computed) {
            if (execution.energy) {
                flows = *execution.energy;
                how.energy = &flows;
            }
            advance(state, base, physics, window, how);
            ++computed;
            reaction = collect(state, static_cast<double>(window), state.clock.extension);
            std::vector<double> residual = load_;
            add_footwall_loads(state, residual);
            std::ranges::transform(residual, holding_forces(state), residual.begin(), std::minus());
            if (!step.empty()) {
                std::vector<double> change(n);
                std::ranges::transform(residual, before, change.begin(), std::minus());
                std::vector<double> found = times(change, false);
                const std::vector<double> left = times(step, true);
                const double scale =
                    std::inner_product(found.begin(), found.end(), step.begin(), 0.0);
                std::ranges::transform(found, step, found.begin(), std::plus());
                if (scale != 0.0)
                    for (std::size_t i = 0; i < n; ++i)
                        for (std::size_t k = 0; k < n; ++k)
                            gives[i * n + k] -= found[i] * left[k] / scale;
            }
            if (n_computed % patience == 0)
                gives = at_first; // contacts have opened and closed: what was found is old
            // How far the base is from where these loads alone would hold it.
            const double off = largest(displacement(residual));
            const BaseNodeColumns tried = base_node_columns(state);
            if (off < std::max({noticed, allowed * largest(tried.ux), allowed * largest(tried.uy)}))
                break;
            if (n_computed < most && off < best_off) {
                best_off = off;
                std::ranges::copy(tried.vx, best.begin());
                std::ranges::copy(tried.vy, best.begin() + static_cast<std::ptrdiff_t>(n / 2));
            }
            if (n_computed > most && off < tolerable)
                break;
            step = times(residual, false);
            before = residual;
            if (n_computed > most || !std::isfinite(off))
                throw NumericalFailure(
                    "elastic_base.scheme strong: no place of the base balances the loads of " +
                    std::to_string(window) + " cycles, the last is " + std::to_string(off) +
                    " m off (allowed: " + std::to_string(noticed) +
                    " m or a thousandth of the displacement); scheme modal needs no iteration");
            state = start;
            const BaseNodeColumns nodes = base_node_columns(state);
            for (std::size_t k = 0; k < nodes.x.size(); ++k) {
                const bool again = n_computed == most; // the best of them
                velocity[2 * k] = again ? best[k] : velocity[2 * k] + step[2 * k] / time;
                velocity[2 * k + 1] =
                    again ? best[n / 2 + k] : velocity[2 * k + 1] + step[2 * k + 1] / time;
                nodes.vx[k] = velocity[2 * k];
                nodes.vy[k] = velocity[2 * k + 1];
            }
        }
        if (execution.energy)
            *execution.energy = flows;
        book(state, static_cast<double>(window), state.clock.extension, reaction);
        ++windows;
        cycles -= window;
    }
    return computed / std::max(1.0, windows);
}

WindowBalance ElasticBase::window(const State& state) const {
    const Table& sums = state.base_memory.at("window");
    const auto sum = [&](const char* name) { return sums.get<double>(name)[0]; };
    const double cycles = std::max(1.0, sum("cycles"));
    return {sum("reaction_error") / cycles, sum("net_load") / cycles, sum("weight_change") / cycles,
            sum("cycles")};
}

Table ElasticBase::window_means(const State& state) const {
    Table means = state.base_memory.at("window_means");
    const double cycles = std::max(1.0, window(state).cycles);
    for (const char* name : {"force", "displacement", "effects"})
        if (means.has(name))
            for (double& sum : means.get<double>(name))
                sum /= cycles;
    return means;
}

void ElasticBase::begin_window(State& state) const {
    Table means;
    means.resize(interface_.unknowns());
    means.add<double>("force", "N", 0.0);
    means.add<double>("displacement", "m", 0.0);
    state.base_memory["window_means"] = std::move(means);
    state.base_memory["window"] = one_row(
        {{"cycles", "1"}, {"reaction_error", "1"}, {"net_load", "N"}, {"weight_change", "N"}});
}

} // namespace listric::coupling
