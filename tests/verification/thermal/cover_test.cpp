// Sediment on rock without discs, left and right of the hanging wall: where all of a section is the
// same column, heat flow is the same everywhere.

#include "dem/columns.hpp"
#include "tests/support.hpp"
#include "tests/verification/thermal/sections.hpp"
#include "thermal/heat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace listric::cover_test {

using namespace dem;
using namespace thermal;
namespace {

constexpr double radius = 75.0, length = 3e3, depth = 1500.0, sunk = 900.0;

/// Rows of discs up to 0 m on rock that has sunk.
State basin() {
    State state = support::rows_of_discs(length, depth, radius);
    const std::vector<double> x{-250e3, 0.0, 250e3}, y(3, 0.0);
    add_base_nodes(state, x, y);
    std::ranges::fill(base_node_columns(state).uy, -sunk);
    return state;
}

/// Fills the basin: discs above rock's top are sediment.
void fill(State& state) {
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.stratum[i] = d.y[i] > -sunk ? 1 : 0;
}

HeatParameters parameters() {
    HeatParameters p;
    p.lithosphere = 6e3;
    p.crust = 3e3;
    p.mantle_conductivity = p.conductivity;
    p.heat_production = 0.0;
    p.base_temperature = 200.0;
    return p;
}

/// @param target  up to which sediment comes, m
HeatSetting setting(double target) {
    HeatSetting s;
    s.beside.wall_x = length;
    s.beside.film = SedimentFilm{.target = Target(target), .wall_x = length};
    s.rock_densities = {2600.0};
    return s;
}

RigidBase base_of_basin() {
    RigidBase base;
    base.surfaces = {{"floor", {line({0.0, -depth}, {length, -depth})}},
                     {"right wall", {line({length, -depth}, {length, 1e4})}}};
    base.motion.stages = {{Travel(0.0), Travel(1e3), Extension(0.0), 0.0}};
    return base;
}

/// The section with sediment on all of its rock, when its temperatures are steady.
struct Steady {
    State state = basin();
    RigidBase base = base_of_basin();
    Schedule schedule{1e6, Calendar(0.01, {{Travel(0.0), Travel(100.0), 10, 10e6}}), InSteps::once};
    HeatPoints points;
    Heat heat;

    explicit Steady(double target)
        : points(parameters(), setting(target), schedule),
          heat(parameters(), setting(target), points, schedule) {
        heat.begin(state);
        points.start(state, base);
        heat.start(state, base);
        fill(state);
        heat.cover_by([](double) { return Cover{sunk, sunk}; });
        for (Event* const event : {static_cast<Event*>(&points), static_cast<Event*>(&heat)}) {
            state.clock.travel = event->next_due();
            event->apply(state, base);
            ++event->applied;
        }
    }
};

// 1.1 % too little beside the discs, below 0.7 % elsewhere: the cells of rock that reach up through
// the sediment hand heat on sideways as rock.
TEST(Cover, ConductsAsTheSedimentOfDiscs) {
    const Steady steady(0.0);
    const HeatParameters p = parameters();
    const double sediment = sediment_conductivity(p.grain_conductivity, 0.5);
    const double exact = 1e3 * (p.base_temperature - p.surface_temperature) /
                         (sunk / sediment + (p.lithosphere - sunk) / p.conductivity);
    const SurfaceHeatFlow flow(steady.heat, steady.state, steady.base);
    for (const double x :
         {-20e3, -3e3, -500.0, 1500.0, length + 500.0, length + 3e3, length + 20e3})
        EXPECT_NEAR(flow.at(x) / exact, 1.0, 0.015) << x;
    EXPECT_LT(std::abs(steady.heat.balance_error()), 1e-10);
}

/// What no disc stands for is a blanket of its thickness over its conductivity, and lessens the
/// heat flow through it: of discs' ground up to the target, and not beside the hanging wall.
TEST(Cover, AFilmIsABlanket) {
    constexpr double film = 100.0;
    const Steady bare(0.0), under(film);
    const GroundLine ground = ground_line(under.state, under.base, setting(film).beside);
    Sites sites;
    for (const double x : {0.5 * length, -251e3, length + 1e3}) // middle, left of the nodes, right
        sites.add({x, -radius}, radius, 5.0 * radius);
    const std::vector<double> resistance =
        under.heat.blanket(under.state, under.base, ground, sites);
    EXPECT_NEAR(resistance[0], film / sediment_conductivity(parameters().grain_conductivity, 0.5),
                1e-9);
    EXPECT_EQ(resistance[1], 0.0);
    EXPECT_EQ(resistance[2], 0.0);
    EXPECT_EQ(bare.heat.blanket(bare.state, bare.base, ground, sites)[0], 0.0);
    const auto flow = [](const Steady& s) {
        return SurfaceHeatFlow(s.heat, s.state, s.base).at(0.5 * length);
    };
    // 4 % for a film that is as wide as all; heat goes around this one of 3 km in rock of 6 km.
    EXPECT_LT(flow(under) / flow(bare), 0.99);
    EXPECT_GT(flow(under) / flow(bare), 0.95);
}

/// Above rock beside a cliff it is no more than what lies on the way to the ground.
TEST(Cover, EndsAtACliff) {
    const Steady steady(0.0);
    const GroundLine ground({{-1e4, 0.0}, {0.0, 0.0}, {0.0, -2e3}, {1e4, -2e3}},
                            {sunk, sunk, 0.0, 0.0});
    Sites sites = steady.heat.cells(steady.state).sites;
    const std::size_t first = sites.count();
    for (const double x : {-5e3, -50.0})
        sites.add({x, -1500.0}, radius, 5.0 * radius);
    const HeatParameters p = parameters();
    const double more =
        1.0 / sediment_conductivity(p.grain_conductivity, 0.5) - 1.0 / p.conductivity;
    const std::vector<double> resistance =
        steady.heat.blanket(steady.state, steady.base, ground, sites);
    EXPECT_NEAR(resistance[first] / (sunk * more), 1.0, 1e-12);
    EXPECT_NEAR(resistance[first + 1] / (50.0 * more), 1.0, 1e-12);
}

/// Right of the wall it goes up to its target, is no thicker than beside the wall, and lies where
/// rock has sunk.
TEST(Cover, GoesOnRightOfTheWall) {
    for (const auto& [target, uplift, expected] : {std::array{0.0, -sunk, sunk},
                                                   {-300.0, -sunk, sunk - 300.0},
                                                   {500.0, -sunk, sunk},
                                                   {0.0, 0.0, 0.0}}) {
        State state = basin();
        fill(state);
        std::ranges::fill(base_node_columns(state).uy, uplift);
        const GroundLine ground = ground_line(state, base_of_basin(), setting(target).beside);
        for (const double x : {length + 10.0, length + 30e3}) {
            EXPECT_NEAR(ground.sediment(x), expected, 1e-9) << target;
            EXPECT_NEAR(ground.height(x), uplift + expected, 1e-9) << target;
        }
    }
}

} // namespace
} // namespace listric::cover_test
