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

std::vector<double> load_difference(std::vector<double> a, std::span<const double> b) {
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

/// Where the interface's unknowns get in a time at their present velocities, m.
std::vector<double> node_steps(const State& state, double time) {
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    std::vector<double> step;
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        step.push_back(nodes.vx[k] * time);
        step.push_back(nodes.vy[k] * time);
    }
    return step;
}

void set_node_steps(State& state, std::span<const double> step, double time) {
    const BaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        nodes.vx[k] = step[2 * k] / time;
        nodes.vy[k] = step[2 * k + 1] / time;
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
    how.packed = nullptr; // attempts begin from copies
    if (execution_.energy) {
        attempt.flows = *execution_.energy;
        how.energy = &attempt.flows;
    }
    advance(state, base_, physics_, cycles, how);
    attempt.load =
        elastic_.take_disc_load(state, static_cast<double>(cycles), state.clock.extension);
    std::vector<double> load = attempt.load.forces;
    add_footwall_loads(state, load);
    attempt.residual = load_difference(std::move(load), elastic_.holding_forces(state));
    attempt.error = largest(elastic_.displacement(attempt.residual));
    return attempt;
}

/// Returns how often the interval was computed.
int StrongScheme::advance_interval(State& state, std::int64_t cycles) {
    const double noticed = error_of_radius * state.mean_radius; // m
    const double time = static_cast<double>(cycles) * state.clock.time_step;
    const State start = state;
    std::vector<double> step = node_steps(start, time);
    Attempt attempt;
    const auto attempts =
        find_root(broyden_, step, [&](std::span<const double> tried, bool is_last) {
            state = start;
            set_node_steps(state, tried, time);
            attempt = compute(state, cycles);
            const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
            const double allowed = std::max(
                {noticed, relative_error * largest(nodes.ux), relative_error * largest(nodes.uy)});
            return Trial{attempt.residual, attempt.error,
                         attempt.error < allowed ||
                             (is_last && attempt.error < hidden_error * noticed)};
        });
    if (!attempts)
        report_failure(cycles, attempt.error, noticed);
    if (execution_.energy)
        *execution_.energy = attempt.flows;
    elastic_.book(state, attempt.load);
    return *attempts;
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
