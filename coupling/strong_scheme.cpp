#include "coupling/strong_scheme.hpp"

#include "coupling/broyden.hpp"
#include "coupling/interface_loads.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr int most_attempts = 24;
constexpr int restart_every = 8;         // contacts open and close: what was learned gets old
constexpr double relative_error = 1e-3;  // of the displacement
constexpr double error_of_radius = 1e-4; // of the discs' mean radius
constexpr double hidden_error = 10.0;    // times that where contacts that open and close hide it

/// The largest size.
double largest(std::span<const double> values) {
    double most = 0.0;
    for (const double value : values)
        if (!(std::abs(value) <= most))
            most = std::abs(value);
    return most;
}

std::vector<double> difference(std::vector<double> a, std::span<const double> b) {
    std::ranges::transform(a, b, a.begin(), std::minus());
    return a;
}

/// What a residual load moves: (S + K)^-1, K that of all contacts; by rows, m per N/m.
std::vector<double> contact_compliance(const ElasticBase& elastic) {
    const Modes& modes = elastic.modes();
    const std::size_t n = modes.unknowns;
    assert(modes.count() == n);
    std::vector<double> result, scaled(n), row(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < n; ++k)
            scaled[k] = modes.by_unknown[i * n + k] /
                        (1.0 / modes.compliance[k] + elastic.parameters().contact_stiffness / 3.0);
        add_rows(modes.by_mode, scaled, row);
        result.insert(result.end(), row.begin(), row.end());
    }
    return result;
}

/// Velocities of the interface's unknowns, m/s.
std::vector<double> node_velocities(const State& state) {
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    std::vector<double> velocity;
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        velocity.push_back(nodes.vx[k]);
        velocity.push_back(nodes.vy[k]);
    }
    return velocity;
}

void set_node_velocities(State& state, std::span<const double> velocity) {
    const BaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        nodes.vx[k] = velocity[2 * k];
        nodes.vy[k] = velocity[2 * k + 1];
    }
}

[[noreturn]] void report_failure(std::int64_t cycles, double error, double allowed) {
    throw NumericalFailure("elastic_base.scheme strong: no place of the base balances the loads "
                           "of " +
                           std::to_string(cycles) + " cycles, the last is " +
                           std::to_string(error) + " m off (allowed: " + std::to_string(allowed) +
                           " m or a thousandth of the displacement); scheme modal needs no "
                           "iteration");
}

class StrongScheme {
public:
    StrongScheme(const ElasticBase& elastic, const RigidBase& base, const CyclePhysics& physics,
                 const Execution& execution)
        : elastic_(elastic), base_(base), physics_(physics), execution_(execution),
          broyden_(contact_compliance(elastic)) {}

    int advance_interval(State& state, std::int64_t cycles);

private:
    /// An interval computed with the velocities of the nodes as they are.
    struct Attempt {
        DiscLoad load;
        std::vector<double> residual; ///< loads less what holds the base where it is, N
        double error = 0.0; ///< how far it is from where these loads alone would hold it, m
        EnergyFlows flows;
    };
    Attempt compute(State& state, std::int64_t cycles) const;

    const ElasticBase& elastic_;
    const RigidBase& base_;
    const CyclePhysics& physics_;
    const Execution& execution_;
    Broyden broyden_; ///< unknowns: displacement of the nodes, residual: loads
};

StrongScheme::Attempt StrongScheme::compute(State& state, std::int64_t cycles) const {
    Attempt attempt;
    Execution how = execution_;
    if (execution_.energy) {
        attempt.flows = *execution_.energy;
        how.energy = &attempt.flows;
    }
    advance(state, base_, physics_, cycles, how);
    attempt.load =
        elastic_.take_disc_load(state, static_cast<double>(cycles), state.clock.extension);
    std::vector<double> load = attempt.load.forces;
    add_footwall_loads(state, load);
    attempt.residual = difference(std::move(load), elastic_.holding_forces(state));
    attempt.error = largest(elastic_.displacement(attempt.residual));
    return attempt;
}

/// Returns how often the interval was computed.
int StrongScheme::advance_interval(State& state, std::int64_t cycles) {
    const double noticed = error_of_radius * state.mean_radius; // m
    const double time = static_cast<double>(cycles) * state.clock.time_step;
    const State start = state;
    std::vector<double> velocity = node_velocities(start), best_velocity = velocity;
    std::vector<double> step, residual_before;
    double least_error = std::numeric_limits<double>::infinity();
    for (int attempts = 1;; ++attempts) {
        const Attempt attempt = compute(state, cycles);
        if (!step.empty())
            broyden_.update(step, difference(attempt.residual, residual_before));
        if (attempts % restart_every == 0)
            broyden_.restart();
        const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
        const double allowed = std::max(
            {noticed, relative_error * largest(nodes.ux), relative_error * largest(nodes.uy)});
        if (attempt.error < allowed ||
            (attempts > most_attempts && attempt.error < hidden_error * noticed)) {
            if (execution_.energy)
                *execution_.energy = attempt.flows;
            elastic_.book(state, attempt.load);
            return attempts;
        }
        if (attempts > most_attempts || !std::isfinite(attempt.error))
            report_failure(cycles, attempt.error, noticed);
        if (attempts < most_attempts && attempt.error < least_error) {
            least_error = attempt.error;
            best_velocity = velocity;
        }
        step = broyden_.step(attempt.residual);
        residual_before = attempt.residual;
        if (attempts == most_attempts)
            velocity = best_velocity; // the update that follows learns from `step` all the same
        else
            for (std::size_t k = 0; k < velocity.size(); ++k)
                velocity[k] += step[k] / time;
        state = start;
        set_node_velocities(state, velocity);
    }
}

} // namespace

double advance_iterated(const ElasticBase& elastic, State& state, const RigidBase& base,
                        const CyclePhysics& physics, std::int64_t cycles,
                        const Execution& execution) {
    assert(elastic.is_iterated());
    StrongScheme scheme(elastic, base, physics, execution);
    double computed = 0.0, intervals = 0.0;
    while (cycles > 0) {
        const std::int64_t interval =
            std::min(cycles, elastic.interval - state.clock.cycle % elastic.interval);
        computed += scheme.advance_interval(state, interval);
        ++intervals;
        cycles -= interval;
    }
    return computed / std::max(1.0, intervals);
}

} // namespace listric::coupling
