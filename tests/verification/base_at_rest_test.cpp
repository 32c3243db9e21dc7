// Where a base without mass rests under the discs that rest on it, found by iteration: the place
// that the modes, which have masses and dampers, come to.

#include "dem/order_free.hpp"
#include "tests/coupled_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace listric {
namespace {

using namespace support;

constexpr int interval = 20; // cycles

/// Loads of the discs on the nodes over an interval, less the reference, and less what holds the
/// base where it is, N. Sets the loads to zero.
std::vector<double> unbalanced_loads(Coupled& c) {
    std::vector<double> loads = c.elastic.holding_forces(c.state);
    const BaseNodeColumns nodes = base_node_columns(c.state);
    const auto reference_x = c.state.base_nodes.get<double>("reference_load_x");
    const auto reference_y = c.state.base_nodes.get<double>("reference_load_y");
    const double unit = load_unit / interval;
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        loads[2 * k] = unit * static_cast<double>(nodes.load_x[k]) - reference_x[k] - loads[2 * k];
        loads[2 * k + 1] =
            unit * static_cast<double>(nodes.load_y[k]) - reference_y[k] - loads[2 * k + 1];
        nodes.load_x[k] = nodes.load_y[k] = 0;
    }
    return loads;
}

/// By how much the nodes move under loads against base and contacts together, m.
std::vector<double> give(const ElasticBase& elastic, std::span<const double> loads) {
    const Modes& modes = elastic.modes();
    std::vector<double> modal(modes.count()), moves(modes.unknowns);
    add_rows(modes.by_unknown, loads, modal);
    for (std::size_t k = 0; k < modal.size(); ++k)
        modal[k] /= 1.0 / modes.compliance[k] + elastic.parameters().contact_stiffness / 3.0;
    add_rows(modes.by_mode, modal, moves);
    return moves;
}

double largest(std::span<const double> values) {
    double most = 0.0;
    for (const double value : values)
        most = std::max(most, std::abs(value));
    return most;
}

/// Repeats an interval from its start until the base ends where its own loads want it. Returns how
/// often it was computed.
int advance_interval(Coupled& c, std::vector<double>& step) {
    const State start = c.state;
    const double time = interval * c.state.clock.time_step;
    for (int tries = 1; tries < 100; ++tries) {
        c.state = start;
        const BaseNodeColumns nodes = base_node_columns(c.state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            nodes.vx[k] = step[2 * k] / time;
            nodes.vy[k] = step[2 * k + 1] / time;
        }
        advance(c.state, c.base, c.physics, interval, {});
        const std::vector<double> loads = unbalanced_loads(c);
        const double allowed = std::max(1e-3 * c.greatest_displacement(), 6e-3);
        if (largest(c.elastic.displacement(loads)) < allowed)
            return tries;
        std::ranges::transform(step, give(c.elastic, loads), step.begin(), std::plus());
    }
    ADD_FAILURE() << "no place of the base balances its loads";
    return 100;
}

TEST(BaseAtRest, IsWhereTheModesComeTo) {
    CouplingParameters never;
    never.interval = interval;
    Coupled modal = settled(floating(1.0, 1.0)), massless = settled(floating(1.0, 1.0), never);
    for (Coupled* c : {&modal, &massless})
        unload(*c);
    modal.go(60000);
    std::vector<double> step(massless.elastic.interface().unknowns(), 0.0);
    int computed = 0;
    constexpr int intervals = 60000 / interval;
    for (int n = 0; n < intervals; ++n)
        computed += advance_interval(massless, step);
    std::printf("modal %.4f m, massless %.4f m, every interval computed %.1f times\n",
                modal.greatest_displacement(), massless.greatest_displacement(),
                static_cast<double>(computed) / intervals);
    EXPECT_GT(massless.greatest_displacement(), 0.1);
    EXPECT_NEAR(massless.greatest_displacement() / modal.greatest_displacement(), 1.0, 0.03);
}

} // namespace
} // namespace listric
