// In a pause by steps the base goes at once to where loads without discs move it, and discs with
// it.

#include "coupling/footwall_loads.hpp"
#include "coupling/interface_loads.hpp"
#include "tests/coupled_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace listric::prompt_base_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

/// Discs on a floating base: 100 m of motion, then two steps of 200 m.
struct Paused {
    ElasticBase elastic{floating(1.0, 1.0), Coupled::complete({})};
    State state =
        make_state({{500.0, -400.0, 50.0}, {1500.0, -1000.0, 50.0}, {3900.0, 50.0, 50.0}});
    RigidBase base;
    PromptBase prompt{elastic, Calendar(0.01, {{Travel(100.0), Travel(200.0), 2, 1e6}})};

    Paused() {
        elastic.attach(state);
        base.motion.stages = {{Travel(0.0), Travel(100.0), Extension(0.0), 1.0},
                              {Travel(100.0), Travel(500.0), Extension(100.0), 0.0}};
        prompt.begin(state);
    }

    /// Puts a load on the base's right half, N per node, goes on to the next moment, and returns
    /// the displacement that this load would have.
    std::vector<double> load(double force) {
        const std::size_t unknowns = elastic.interface().unknowns(); // half of them is odd
        const auto forces = interface_load(state, "film", unknowns);
        for (std::size_t k = unknowns / 2; k < unknowns; k += 2)
            forces[k] = -force;
        state.clock.travel = prompt.next_due();
        prompt.apply(state, base);
        ++prompt.applied;
        return elastic.displacement({forces.begin(), forces.end()});
    }
};

TEST(PromptBase, TakesBaseAndDiscsToWhereLoadsMoveThem) {
    Paused paused;
    const std::vector<double> y{-400.0, -1000.0, 50.0};
    const auto discs = [&] { return disc_columns(std::as_const(paused.state)).y; };
    for (int k = 0; k < 3; ++k) { // in motion the base goes by its modes
        paused.load(1e8);
        EXPECT_EQ(base_node_columns(std::as_const(paused.state)).uy.back(), 0.0);
        EXPECT_EQ(discs()[2], y[2]);
    }
    paused.load(1e8);
    const std::vector<double> before = paused.elastic.displacement(
        std::vector<double>(interface_loads(paused.state))); // what is there when the pause begins
    for (const double force : {3e8, 3e8, 2e8}) {             // the change alone moves it, once
        const std::vector<double> place = paused.load(force);
        const auto uy = base_node_columns(std::as_const(paused.state)).uy;
        EXPECT_LT(place.back(), -5.0);
        for (std::size_t k = 0; k < uy.size(); ++k)
            EXPECT_NEAR(uy[k], place[2 * k + 1] - before[2 * k + 1], 1e-6); // of modes
        const auto sunk = [&](double x) { // of the node that is nearest to x
            std::size_t nearest = 0;
            for (std::size_t k = 0; k < uy.size(); ++k)
                if (std::abs(paused.elastic.interface().x[k] - x) <
                    std::abs(paused.elastic.interface().x[nearest] - x))
                    nearest = k;
            return uy[nearest];
        };
        const std::vector<double> x{500.0, 1500.0, 3900.0};
        for (std::size_t i = 0; i < x.size(); ++i) // nodes are up to 98 m apart
            EXPECT_NEAR((discs()[i] - y[i]) / sunk(x[i]), 1.0, 0.1);
    }
}

/// A film that a disc takes the place of moves nothing; what comes besides does.
TEST(PromptBase, CountsTheDiscsThatCome) {
    Paused paused;
    for (int k = 0; k < 4; ++k)
        paused.load(0.0);
    constexpr double mass = 1e7;
    const auto uy = [&] { return base_node_columns(std::as_const(paused.state)).uy; };
    ASSERT_EQ(uy()[30], 0.0);
    const DiscColumns d = disc_columns(paused.state);
    const std::size_t node = 40;
    d.x[0] =
        0.25 * paused.elastic.interface().x[node] + 0.75 * paused.elastic.interface().x[node + 1];
    paused.load(0.0);
    const std::vector<double> before(uy().begin(), uy().end());
    d.mass[0] += mass;
    paused.load(0.0);
    std::vector<double> weight(paused.elastic.interface().unknowns(), 0.0);
    weight[2 * node + 1] = -0.25 * mass * standard_gravity;
    weight[2 * node + 3] = -0.75 * mass * standard_gravity;
    const std::vector<double> moved = paused.elastic.displacement(weight);
    for (std::size_t k = 0; k < before.size(); ++k)
        EXPECT_NEAR((uy()[k] - before[k]) / moved[2 * k + 1], 1.0, 1e-9);
    const std::vector<double> sunk(uy().begin(), uy().end());
    std::ranges::copy(weight, interface_load(paused.state, "film", weight.size()).begin());
    d.mass[0] -= mass;
    paused.state.clock.travel = paused.prompt.next_due();
    paused.prompt.apply(paused.state, paused.base);
    for (std::size_t k = 0; k < sunk.size(); ++k)
        EXPECT_NEAR(uy()[k], sunk[k], 1e-9);
}

} // namespace
} // namespace listric::prompt_base_test
