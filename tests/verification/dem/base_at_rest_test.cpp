// Where a base without mass rests under the discs that rest on it, found by iteration: the place
// that the modes, which have masses and dampers, come to.

#include "dem/numbers/order_free.hpp"
#include "tests/coupled_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace listric::base_at_rest_test {
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

/// Broyden's method for the place where no load is unbalanced: Newton's, with an inverse Jacobian
/// that begins with the compliance of base and contacts together and learns from each trial.
class Broyden {
public:
    explicit Broyden(const ElasticBase& elastic) : n_(elastic.modes().unknowns) {
        const Modes& modes = elastic.modes();
        std::vector<double> scaled(n_), row(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            for (std::size_t k = 0; k < n_; ++k)
                scaled[k] =
                    modes.by_unknown[i * n_ + k] /
                    (1.0 / modes.compliance[k] + elastic.parameters().contact_stiffness / 3.0);
            add_rows(modes.by_mode, scaled, row);
            first_.insert(first_.end(), row.begin(), row.end());
        }
        restart();
    }

    void restart() { inverse_ = first_; }

    std::vector<double> step(std::span<const double> residual) const {
        std::vector<double> result(n_, 0.0);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t k = 0; k < n_; ++k)
                result[i] += inverse_[i * n_ + k] * residual[k];
        return result;
    }

    /// Learns that this step changed the residual by so much.
    void update(std::span<const double> step, std::span<const double> change) {
        std::vector<double> correction = this->step(change), row(n_, 0.0);
        double scale = 0.0;
        for (std::size_t i = 0; i < n_; ++i) {
            scale += correction[i] * step[i];
            correction[i] += step[i];
            for (std::size_t k = 0; k < n_; ++k)
                row[k] += inverse_[i * n_ + k] * step[i];
        }
        if (scale == 0.0)
            return;
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t k = 0; k < n_; ++k)
                inverse_[i * n_ + k] -= correction[i] * row[k] / scale;
    }

private:
    std::size_t n_;
    std::vector<double> first_, inverse_; // by rows, m per N/m
};

std::vector<double> difference(std::vector<double> a, std::span<const double> b) {
    std::ranges::transform(a, b, a.begin(), std::minus());
    return a;
}

double largest(std::span<const double> values) {
    double most = 0.0;
    for (const double value : values)
        most = std::max(most, std::abs(value));
    return most;
}

/// Repeats an interval from its start until the base ends where its own loads want it: to a
/// thousandth of its displacement or a ten-thousandth of the discs' radius; to a thousandth of that
/// where contacts that open and close hide it. Returns how often it was computed.
int advance_interval(Coupled& c, Broyden& broyden) {
    const State start = c.state;
    const double time = interval * c.state.clock.time_step, noticed = 1e-4 * c.state.mean_radius;
    std::vector<double> step, best, step_before, loads_before;
    const ConstBaseNodeColumns held = base_node_columns(start);
    for (std::size_t k = 0; k < held.x.size(); ++k)
        step.insert(step.end(), {held.vx[k] * time, held.vy[k] * time});
    double least = std::numeric_limits<double>::infinity();
    constexpr int most = 24, restart_every = 8;
    for (int trial = 1; trial <= most + 1; ++trial) {
        c.state = start;
        const BaseNodeColumns nodes = base_node_columns(c.state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            nodes.vx[k] = step[2 * k] / time;
            nodes.vy[k] = step[2 * k + 1] / time;
        }
        advance(c.state, c.base, c.physics, interval, {});
        const std::vector<double> loads = unbalanced_loads(c);
        const double error = largest(c.elastic.displacement(loads));
        if (!step_before.empty())
            broyden.update(difference(step, step_before), difference(loads, loads_before));
        if (trial % restart_every == 0) // loads kink where contacts open
            broyden.restart();
        if (error < std::max(noticed, 1e-3 * c.greatest_displacement()) ||
            (trial > most && error < 10.0 * noticed))
            return trial;
        if (error < least) {
            least = error;
            best = step;
        }
        step_before = step;
        loads_before = loads;
        if (trial == most)
            step = best;
        else
            std::ranges::transform(step, broyden.step(loads), step.begin(), std::plus());
    }
    ADD_FAILURE() << "no place of the base balances its loads, the best is " << least << " m off";
    return most;
}

TEST(BaseAtRest, IsWhereTheModesComeTo) {
    Coupled modal = settled(floating(1.0, 1.0)), massless = settled(floating(1.0, 1.0));
    for (Coupled* c : {&modal, &massless})
        unload(*c);
    modal.go(60000);
    Broyden broyden(massless.elastic);
    int computed = 0;
    constexpr int intervals = 60000 / interval;
    for (int n = 0; n < intervals && !HasFailure(); ++n)
        computed += advance_interval(massless, broyden);
    std::printf("modal %.4f m, massless %.4f m, every interval computed %.1f times\n",
                modal.greatest_displacement(), massless.greatest_displacement(),
                static_cast<double>(computed) / intervals);
    EXPECT_GT(massless.greatest_displacement(), 0.1);
    EXPECT_NEAR(massless.greatest_displacement() / modal.greatest_displacement(), 1.0, 0.03);
}

} // namespace
} // namespace listric::base_at_rest_test
