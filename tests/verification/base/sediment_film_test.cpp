// Sediment that no disc stands for: what it weighs, with and without water, and that a base sinks
// under it as under a layer without discs.

#include "coupling/basin_water.hpp"
#include "coupling/interface_loads.hpp"
#include "tests/coupled_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace listric::sediment_film_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

constexpr double grains = 2600.0, porosity = 0.4, water = 1030.0; // kg/m^3
constexpr double r = 50.0, column = 4.0 * r, wall = 5000.0;       // m
constexpr double gravity = standard_gravity;

/// A flat interface, and a row of discs on it whose tops are the ground, at a depth.
struct Section {
    Interface interface;
    State state;
    RigidBase base;

    explicit Section(double depth, Interface made = flat()) : interface(std::move(made)) {
        std::vector<Disc> discs;
        for (double x = r; x < wall; x += 2.0 * r)
            discs.push_back({x, -depth - r, r});
        state = make_state(discs);
        add_base_nodes(state, interface.x, interface.y);
        base.surfaces = {{"floor", {line({0.0, -2e3}, {wall, -2e3})}},
                         {"right wall", {line({wall, -2e3}, {wall, 1e4})}}};
    }

    static Interface flat() {
        Interface flat;
        for (int k = 0; k <= 100; ++k) {
            flat.x.push_back(100.0 * k);
            flat.y.push_back(-2e3);
        }
        return flat;
    }

    /// Weight on the interface of what an effect puts there, N/m.
    double weight(const char* effect) {
        const auto load = interface_load(state, effect, 2 * interface.x.size());
        return -std::accumulate(load.begin(), load.end(), 0.0);
    }
};

FilmLoadParameters parameters(double target) {
    return {.film = {.target = Target(target),
                     .deposition = Schedule(50e3, 0.01),
                     .surface_porosity = porosity,
                     .wall_x = wall},
            .grain_density = grains,
            .gravity = gravity,
            .column_width = column};
}

/// Weight of the film alone, N/m.
double film_weight(Section& section, const FilmLoadParameters& p) {
    FilmLoad load(section.interface, p);
    load.begin(section.state);
    EXPECT_FALSE(load.apply(section.state, section.base)); // neighbours are the same
    return section.weight("film");
}

TEST(SedimentFilm, FillsUpToADisc) {
    constexpr double per_metre = (1.0 - porosity) * grains * gravity * wall;
    for (const auto& [depth, thickness] : {std::pair{30.0, 30.0}, // as thick as there is room
                                           {80.0, 80.0},
                                           {300.0, 2.0 * r}, // no disc will fill the rest
                                           {-20.0, 0.0}}) {
        Section section(depth);
        EXPECT_NEAR(film_weight(section, parameters(0.0)), per_metre * thickness,
                    1e-9 * per_metre * r)
            << depth;
    }
    Section higher(300.0);
    EXPECT_NEAR(film_weight(higher, parameters(-260.0)), per_metre * 40.0, 1e-9 * per_metre);
}

/// On the base where that is bare above the discs' ground: a scarp.
TEST(SedimentFilm, LiesOnTheBareBase) {
    Section section(80.0);
    const BaseNodeColumns nodes = base_node_columns(section.state);
    constexpr double scarp = 2e3;
    for (std::size_t k = 0; k < nodes.x.size(); ++k)
        if (nodes.x[k] <= scarp)
            nodes.uy[k] = 2e3 - 20.0;
    const double expected =
        (1.0 - porosity) * grains * gravity * (scarp * 20.0 + 80.0 * (wall - scarp));
    EXPECT_NEAR(film_weight(section, parameters(0.0)), expected, 1e-9 * expected);
}

/// Its top is the target of now, its pores are those of the bed of now.
TEST(SedimentFilm, GoesByItsAge) {
    Section section(80.0);
    SedimentFilm film = parameters(0.0).film; // strata are 500 m of travel apart
    film.target = Target(0.0, {{0.0, {{0.0, 0.0}}}, {100e3, {{0.0, 50.0}}}});
    film.beds = {.list = {{100e3, {.surface_porosity = 0.3}}, {1e9, {.surface_porosity = 0.6}}},
                 .deposition = film.deposition};
    for (const auto& [travel, top, pores] :
         {std::array{400.0, 20.0, 0.3}, {800.0, 40.0, 0.3}, {5000.0, 50.0, 0.6}}) {
        section.state.clock.travel = Travel(travel);
        const auto now = film.now(section.state, section.base);
        EXPECT_DOUBLE_EQ(now->target.height(0.0), top);
        EXPECT_DOUBLE_EQ(now->porosity, pores);
    }
}

/// It is weighed at every stratum, and in between so often that travel is at most 25 m.
TEST(SedimentFilm, IsWeighedOften) {
    SedimentFilm film;
    for (const auto& [strata, between] :
         {std::pair{500.0, 25.0}, {130.0, 130.0 / 6.0}, {20.0, 20.0}}) {
        film.deposition = Schedule(strata / 0.01, 0.01);
        EXPECT_NEAR(film_schedule(film).spacing(), between, 1e-9);
    }
}

/// Where the present stage does not fill, the room is of water or air.
TEST(SedimentFilm, IsWhereTheStageFills) {
    Section section(80.0);
    section.base.motion.stages = {
        {.start = Travel(0.0), .end = Travel(500.0), .surface = SurfaceWork::fill},
        {.start = Travel(500.0), .end = Travel(900.0), .surface = SurfaceWork::erode}};
    section.state.clock.travel = Travel(499.0);
    EXPECT_GT(film_weight(section, parameters(0.0)), 0.0);
    section.state.clock.travel = Travel(501.0);
    EXPECT_EQ(film_weight(section, parameters(0.0)), 0.0);
}

/// Both below the level and half out of it. The sum is that of saturated sediment below water:
/// nothing is counted twice.
TEST(SedimentFilm, LiesInTheWater) {
    for (const double level : {0.0, -50.0, -200.0, -250.0}) {
        constexpr double depth = 300.0, thickness = 2.0 * r; // up to -200 m
        const double wet = std::clamp(level + depth, 0.0, thickness);
        const double above = std::max(0.0, level + depth - thickness);
        const double of_film =
            ((1.0 - porosity) * grains * thickness + porosity * water * wet) * gravity * wall;
        Section section(depth);
        FilmLoadParameters p = parameters(0.0);
        BasinWater basin(section.interface, {.level = level, .density = water, .film = p.film},
                         gravity, column, Calendar(0.01), PoreSpace{grains, porosity});
        const double film = film_weight(section, p);
        basin.begin(section.state);
        basin.memory.get<double>("start_depth_m")[0] = 0.0;
        basin.apply(section.state, section.base);
        // Water alone lies in whole columns up to the last disc's middle.
        const double expected = of_film + water * above * gravity * (wall - column);
        EXPECT_NEAR(film + section.weight("basin_water") + section.weight("pore_water"), expected,
                    1e-9 * expected)
            << level;
        EXPECT_NEAR(section.weight("pore_water"), porosity * water * wet * gravity * wall,
                    1e-9 * expected);
        // Where water presses on the base itself, up to its level, grains displace some of it.
        p.level = WaterLevel{Target(level)};
        p.water_density = water;
        EXPECT_NEAR(film_weight(section, p) + water * wet * gravity * wall, of_film,
                    1e-9 * expected);
    }
}

/// A base that floats as one, under a target that rises by less than a disc: it sinks by what a
/// layer without discs does.
TEST(SedimentFilm, SinksAsUnderALayerWithoutDiscs) {
    Section section(0.0, floating(1e-6, 1.0));
    const ElasticBase elastic(section.interface, Coupled::complete({}));
    const std::vector<double> forces(section.interface.unknowns(), 0.0);
    const BaseNodeColumns nodes = base_node_columns(section.state);
    const DiscColumns d = disc_columns(section.state);
    double sunk = 0.0;
    for (int step = 0; step < 60; ++step) {
        FilmLoad load(section.interface, parameters(std::min(40.0, 1.0 * step)));
        load.begin(section.state);
        load.apply(section.state, section.base);
        const std::vector<double> moved = elastic.displacement(interface_loads(section.state));
        const double before = sunk;
        sunk = -moved.back();
        for (double& uy : nodes.uy)
            uy = -sunk;
        for (double& y : d.y)
            y += before - sunk;
    }
    // 40 m and what has sunk lie on the columns below the hanging wall.
    const double share = (1.0 - porosity) * grains * gravity * wall / (mantle * afloat);
    const double expected = share / (1.0 - share) * 40.0;
    EXPECT_NEAR(sunk / expected, 1.0, 1e-3); // rock bends by a millionth of that
}

} // namespace
} // namespace listric::sediment_film_test
