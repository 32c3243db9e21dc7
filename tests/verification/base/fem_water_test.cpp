// Water in the pores of sediment and on the sunken flank, against weights by hand.

#include "coupling/basin_water.hpp"
#include "coupling/interface_loads.hpp"
#include "tests/support.hpp"
#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

namespace listric::fem_water_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

constexpr double water_density = 1030.0; // kg/m^3

/// A flat at a depth of 2 km, and on it a row of rock and three discs of sediment.
class PoreWater : public testing::Test {
protected:
    static constexpr double r = 50.0, column = 200.0;
    Interface interface_;
    State state_;

    PoreWater() {
        for (int k = 0; k <= 40; ++k) {
            interface_.x.push_back(500.0 * k);
            interface_.y.push_back(-2000.0);
        }
        std::vector<Disc> discs;
        for (int k = 0; k < 100; ++k)
            discs.push_back({r + 2.0 * r * k, -1000.0, r});
        discs.push_back({450.0, -900.0, r}); // below the level
        discs.push_back({9990.0, -900.0, r});
        discs.push_back({650.0, -800.0, r}); // its middle is at the level of some tests
        state_ = make_state(discs);
        add_base_nodes(state_, interface_.x, interface_.y);
        const DiscColumns d = disc_columns(state_);
        for (std::size_t i = 100; i < 103; ++i) {
            d.stratum[i] = 1;
            d.mass[i] = 2600.0 * 800.0; // grains of 800 m^2
        }
    }

    double sum(double level, const PoreSpace& pores) const {
        double all = 0.0;
        for (const double area : pore_water(state_, level, pores, column))
            all += area;
        return all;
    }
};

TEST_F(PoreWater, FillsThePoresBelowTheLevel) {
    // 0.2 of pores to 0.8 of grains.
    const std::vector<double> water = pore_water(state_, 0.0, {2600.0, 0.2}, column);
    ASSERT_EQ(water.size(), 49u);
    EXPECT_NEAR(water[2], 200.0, 1e-9);
    EXPECT_NEAR(water[3], 200.0, 1e-9);
    EXPECT_NEAR(water[48], 200.0, 1e-9); // the last column takes what lies beyond its end
    // The bulk is as heavy as rock of that porosity that is saturated.
    EXPECT_NEAR((2600.0 * 800.0 + water_density * water[2]) / 1000.0,
                2600.0 * 0.8 + water_density * 0.2, 1e-9);
    EXPECT_NEAR(sum(-800.0, {2600.0, 0.2}), 500.0, 1e-9); // half of the highest disc
    EXPECT_EQ(sum(-1000.0, {2600.0, 0.2}), 0.0);
    EXPECT_EQ(sum(0.0, {2600.0, 0.0}), 0.0);
    // Discs that compact have their own: half as much again, and none.
    state_.discs.add<double>("porosity", "1", 0.5);
    const auto porosity = state_.discs.get<double>("porosity");
    porosity[100] = 0.5;
    porosity[101] = porosity[102] = 0.0;
    EXPECT_NEAR(sum(0.0, {2600.0, 0.2}), 800.0, 1e-9);
}

TEST_F(PoreWater, WeighsOnTheDetachmentBesideTheWaterAbove) {
    const BasinWaterParameters parameters{.level = 0.0, .density = water_density};
    BasinWater dry(interface_, parameters, standard_gravity, column, 0.01);
    BasinWater wet(interface_, parameters, standard_gravity, column, 0.01, PoreSpace{2600.0, 0.2});
    State with = state_;
    for (auto [water, state] : {std::pair(&dry, &state_), std::pair(&wet, &with)}) {
        water->begin(*state);
        water->memory.get<double>("start_depth_m")[0] = 0.0;
        EXPECT_FALSE(water->apply(*state, {}));
    }
    EXPECT_EQ(pore_water_weight(state_), 0.0);
    EXPECT_FALSE(state_.base_memory.at("interface_loads").has("pore_water"));
    const double pores = 600.0 * water_density * standard_gravity;
    EXPECT_NEAR(pore_water_weight(with), pores, 1e-9 * pores);
    // To the tops of rock in 47 columns, of sediment in two; the last disc is in none.
    const double free = column * (47 * 950.0 + 850.0 + 750.0) * water_density * standard_gravity;
    EXPECT_NEAR(water_weight(state_), free, 1e-9 * free);
    EXPECT_NEAR(water_weight(with), free + pores, 1e-9 * free);
    // It lies on the nodes below: those of the columns from 400 to 800 m and of the last one.
    const auto load = with.base_memory.at("interface_loads").get<double>("pore_water");
    double moment = 0.0;
    for (std::size_t k = 0; k < interface_.x.size(); ++k) {
        moment -= interface_.x[k] * load[2 * k + 1];
        EXPECT_EQ(load[2 * k], 0.0);
    }
    EXPECT_NEAR(moment, pores / 3.0 * (500.0 + 700.0 + 9700.0), 1e-9 * moment);
}

TEST_F(PoreWater, RaisedGroundThatWasFloodedLosesLoad) {
    for (const double level : {0.0, 100.0}) {
        State state = state_;
        BasinWater water(interface_, {.level = level, .density = water_density}, standard_gravity,
                         column, 0.01);
        water.begin(state);
        water.apply(state, {});
        const double before = water_weight(state);
        // The mean depth is that of the start: tops of single discs cancel out.
        if (level > 0.0) {
            EXPECT_NEAR(before, 0.0, 1e-6 * column * 49 * 1000.0 * water_density);
        }
        for (double& y : disc_columns(state).y)
            y += 200.0;
        water.apply(state, {});
        // 200 m less of water in 49 columns; at a level of 0 only what comes counts.
        const double less = 200.0 * column * 49 * water_density * standard_gravity;
        EXPECT_NEAR(water_weight(state), level > 0.0 ? -less : 0.0, 1e-6 * less);
    }
}

/// A flat crust that floats; rollers on its sides, so that under even loads it is one column.
class FlankWater : public testing::Test {
protected:
    static constexpr double weight = water_density * standard_gravity;
    std::vector<double> knots_ = surface_knots(100e3, -100e3);
    std::unique_ptr<fem::Footwall> footwall_ = fem::make_footwall(request());
    double share_ = 0.0; ///< of its depth, by which the flank sinks under water
    SurfaceResponse response_ = respond();

    static fem::FootwallRequest request() {
        fem::FootwallRequest request = layer(30e3, -100e3, 0.0, 5e3);
        request.surface_spring = 2700.0 * standard_gravity;
        request.base_spring = 600.0 * standard_gravity;
        return request;
    }
    SurfaceResponse respond() {
        const std::vector<std::vector<fem::Load>> loads = {surface_loads(knots_)};
        const LoadResponse solved =
            solve_unit_loads(*footwall_, loads, 2 * footwall_->interface().size()).front();
        // The column's stiffness: lambda + 2 mu over its height.
        const double stiffness = 70e9 * 0.75 / (1.25 * 0.5) / 30e3, base = 600.0 * standard_gravity;
        share_ = weight / (2700.0 * standard_gravity + base / (1.0 + base / stiffness));
        return {knots_, solved.interface, solved.sums, solved.work.front()};
    }
    void expect_even(double height, double level, double depth) const {
        const std::vector<double> dry(knots_.size(), height);
        for (const double found : flank_depths(response_, dry, level, weight))
            EXPECT_NEAR(found, depth, 2e-3) << height << " " << level;
    }
};

TEST_F(FlankWater, IsAsDeepAsTheFlankSinksUnderIt) {
    EXPECT_NEAR(share_, water_density / 3300.0, 1e-3);
    expect_even(-100.0, 0.0, 100.0 / (1.0 - share_));
    expect_even(-100.0, -40.0, 60.0 / (1.0 - share_)); // dry down to there
    expect_even(-30.0, -40.0, 0.0);
    expect_even(100.0, 0.0, 0.0);
    expect_even(-100.0, 50.0, 100.0 / (1.0 - share_)); // under 50 m at the start
    expect_even(80.0, 50.0, -50.0);                    // falls dry
}

TEST_F(FlankWater, IsALoadOfTheFlank) {
    const std::size_t unknowns = 2 * footwall_->interface().size();
    Interface interface;
    for (const fem::InterfaceNode& node : footwall_->interface()) {
        interface.x.push_back(node.place.x + 100e3); // any will do
        interface.y.push_back(-2000.0);
    }
    State state = make_state({{50.0, -50.0, 50.0}, {1050.0, -50.0, 50.0}});
    add_base_nodes(state, interface.x, interface.y);
    double height = 0.0;
    Flank flank{response_, std::vector<double>(knots_.size() * unknowns, 0.0),
                [&](const State&) { return std::vector<double>(knots_.size(), height); }};
    flank.forces[1] = 2.0; // of the first knot on the first node
    BasinWater water(interface, {.level = 0.0, .density = water_density}, standard_gravity, 200.0,
                     0.01, {}, flank);
    water.begin(state);
    water.apply(state, {});
    EXPECT_EQ(water.flank_weight(), 0.0);
    height = -100.0;
    water.apply(state, {});
    const double pressure = weight * 100.0 / (1.0 - share_);
    EXPECT_NEAR(water.flank_weight(), pressure * 100e3, 1e-4 * pressure * 100e3);
    EXPECT_NEAR(water.flank_load().traction({-50e3, 0.0}, {0.0, 1.0}, fem::Boundary::surface).y,
                -pressure, 1e-4 * pressure);
    EXPECT_NEAR(state.base_memory.at("footwall_loads").get<double>("basin_water")[1],
                2.0 * pressure, 1e-4 * pressure);
}

} // namespace
} // namespace listric::fem_water_test
