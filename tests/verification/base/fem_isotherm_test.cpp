// Strength of the footwall that ends at an isotherm which moves: against elastic footwalls of one
// thickness, and the condensed base against the whole one.

#include "coupling/base_memory.hpp"
#include "coupling/interface_loads.hpp"
#include "coupling/lower_crust_thinning.hpp"
#include "coupling/moving_isotherm.hpp"
#include "tests/support.hpp"
#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace listric::fem_isotherm_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

constexpr double round_off = 1e-9; // relative: rock of 1/100 of the stiffness

fem::FootwallRequest footwall_of(double elastic_thickness) {
    fem::FootwallRequest request = small_footwall();
    request.left = -80e3;
    request.right = 110e3;
    request.interface_end = 60e3;
    request.elastic_thickness = elastic_thickness;
    request.skin_thickness = 3e3;
    return request;
}

std::vector<Point> level(double depth) { return {{-80e3, -depth}, {110e3, -depth}}; }

fem::FootwallRequest with_isotherm(double depth) {
    fem::FootwallRequest request = footwall_of(10e3); // elements as of that thickness
    request.isotherm = isotherm_of(level(depth));
    return request;
}

/// The same elements with a thickness of another depth.
fem::FootwallRequest elastic(double depth) { return with_isotherm(depth); }

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0.0, size = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        square += (a[k] - b[k]) * (a[k] - b[k]);
        size += b[k] * b[k];
    }
    return std::sqrt(square / size);
}

fem::Load load_of(const fem::Footwall& footwall, double size) {
    fem::Load load;
    for (std::size_t k = 0; k < 2 * footwall.interface().size(); ++k)
        load.interface.push_back(k % 2 ? size * std::cos(0.02 * static_cast<double>(k)) : 0.0);
    return load;
}

std::vector<double> under(fem::Footwall& footwall, const fem::Load& load) {
    footwall.solve(load);
    return footwall.interface_displacement();
}

TEST(Isotherm, ThatStaysIsAnElasticThickness) {
    const auto thick = fem::make_footwall(footwall_of(10e3));
    const auto hot = fem::make_footwall(with_isotherm(10e3));
    EXPECT_FALSE(hot->stress_points().empty());
    const fem::Load load = load_of(*thick, 1e11);
    EXPECT_LT(difference(under(*hot, load), under(*thick, load)), round_off);
    const auto other = fem::make_footwall(with_isotherm(13e3));
    EXPECT_GT(difference(under(*other, load), under(*thick, load)), 0.02);
}

/// Rock that cools begins with the stress it has: nothing moves, and what comes then bends the
/// thicker plate.
TEST(Isotherm, ThatSinksFreezesTheBendAndStiffensWhatComes) {
    const auto footwall = fem::make_footwall(with_isotherm(8e3));
    const auto thick = fem::make_footwall(elastic(15e3));
    fem::Load load = load_of(*footwall, 1e11);
    const std::vector<double> before = under(*footwall, load);
    load.stress = footwall->stress_left_below(isotherm_of(level(15e3)));
    footwall->take_isotherm(isotherm_of(level(15e3)));
    EXPECT_LT(difference(under(*footwall, load), before), round_off);
    const fem::Load more = load_of(*footwall, 3e10);
    for (std::size_t k = 0; k < more.interface.size(); ++k)
        load.interface[k] += more.interface[k];
    std::vector<double> rise = under(*footwall, load);
    for (std::size_t k = 0; k < rise.size(); ++k)
        rise[k] -= before[k];
    EXPECT_LT(difference(rise, under(*thick, more)), round_off);
    EXPECT_GT(difference(before, under(*thick, load_of(*footwall, 1e11))), 0.02);
}

/// Rock that heats sheds its stress: the plate bends as if it had always been thin.
TEST(Isotherm, ThatRisesLeavesTheThinPlate) {
    const auto footwall = fem::make_footwall(with_isotherm(15e3));
    const auto thin = fem::make_footwall(elastic(8e3));
    fem::Load load = load_of(*footwall, 1e11);
    const std::vector<double> before = under(*footwall, load);
    load.stress = footwall->stress_left_below(isotherm_of(level(8e3)));
    footwall->take_isotherm(isotherm_of(level(8e3)));
    const std::vector<double> after = under(*footwall, load);
    EXPECT_LT(difference(after, under(*thin, load_of(*footwall, 1e11))), round_off);
    EXPECT_GT(difference(after, before), 0.02);
}

constexpr LowerCrustThinningParameters thinning{20e3, 60e3, 15e3};
constexpr double contrast = 600.0 * standard_gravity;

/// Loads on a base whose isotherm goes as it is told.
struct Base {
    std::vector<Point> line = level(12e3);
    std::unique_ptr<fem::Footwall> footwall = fem::make_footwall(with_isotherm(12e3));
    ElasticBase base{condense(*footwall, 2), {}};
    std::vector<std::unique_ptr<Event>> events;
    FootwallLoads loads{
        *footwall, base,
        std::vector{lower_crust_thinning_load(thinning, contrast, 1200.0, 0.0, 0.001)}, events};
    MovingIsotherm isotherm{*footwall,
                            base,
                            loads,
                            level(12e3),
                            [this](const State&, const RigidBase&) { return line; },
                            1000.0,
                            Schedule(1e5, 0.001)};
    State state;
    RigidBase rigid;

    Base() {
        base.attach(state);
        isotherm.begin(state);
        events.front()->begin(state);
    }
    std::vector<double> rest_under(std::vector<double> forces) {
        add_footwall_loads(state, forces);
        const std::vector<double> u = base.displacement(forces);
        const BaseNodeColumns nodes = base_node_columns(state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k) {
            nodes.ux[k] = u[2 * k];
            nodes.uy[k] = u[2 * k + 1];
        }
        return u;
    }
};

/// What discs meet, against solutions of the whole footwall that remember their stress, and a base
/// that goes on from the state.
TEST(Isotherm, TheCondensedBaseMovesAsTheWholeOne) {
    Base condensed;
    const auto whole = fem::make_footwall(with_isotherm(12e3));
    std::vector<double> stress;
    const std::size_t unknowns = condensed.base.interface().unknowns();
    double worst = 0.0;
    // Up and down again, aslant, too early after the last change, and by less than a row.
    const std::vector<std::pair<double, std::vector<Point>>> lines{
        {0.0, level(12e3)},
        {600.0, level(9e3)},
        {1200.0, {{-80e3, -14e3}, {10e3, -7e3}, {110e3, -16e3}}},
        {1800.0, level(13e3)},
        {2200.0, level(11e3)},
        {2400.0, level(13.5e3)}};
    int changes = 0;
    for (std::size_t step = 0; step < lines.size(); ++step) {
        State& state = condensed.state;
        const double extension = 120.0 * static_cast<double>(step);
        state.clock.extension.m = extension;
        condensed.events.front()->apply(state, condensed.rigid);
        std::vector<double> forces(unknowns);
        for (std::size_t k = 0; k < unknowns; ++k)
            forces[k] = 2e10 * (1.0 + 0.3 * static_cast<double>(step)) *
                        std::sin(0.1 * static_cast<double>(k + step));
        fem::Load load = lower_crust_load(thinning, contrast, extension);
        load.interface = forces;
        load.interface.resize(2 * whole->interface().size(), 0.0);
        load.stress = stress;
        std::vector<double> exact = under(*whole, load);
        exact.resize(unknowns);
        worst = std::max(worst, difference(condensed.rest_under(forces), exact));
        state.clock.travel = Travel(lines[step].first);
        condensed.line = lines[step].second;
        const double since = isotherm(state)->since;
        condensed.isotherm.apply(state, condensed.rigid);
        if (isotherm(state)->since == since)
            continue;
        ++changes;
        stress = whole->stress_left_below(isotherm_of(lines[step].second));
        whole->take_isotherm(isotherm_of(lines[step].second));
    }
    std::printf("condensed against whole: %.1e\n", worst);
    EXPECT_LT(worst, round_off);
    EXPECT_EQ(changes, 3);
    Base resumed;
    resumed.isotherm.go_on_with(condensed.state);
    EXPECT_EQ(resumed.base.interface().compliance, condensed.base.interface().compliance);
}

} // namespace
} // namespace listric::fem_isotherm_test
