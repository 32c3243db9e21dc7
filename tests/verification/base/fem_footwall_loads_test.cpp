// Loads on the footwall that no disc brings, against columns of rock on springs.

#include "coupling/basin_water.hpp"
#include "coupling/footwall_erosion.hpp"
#include "coupling/independent_solution.hpp"
#include "coupling/lower_crust_thinning.hpp"
#include "tests/support.hpp"
#include "tests/verification/footwalls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace listric::fem_footwall_loads_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

constexpr double crust = 2700.0, mantle = 3300.0; // kg/m^3
constexpr double contrast = (mantle - crust) * standard_gravity;

/// A flat crust that floats; rollers on its sides, so that under even loads it is one column.
fem::FootwallRequest floating_crust() {
    fem::FootwallRequest request = layer(30e3, -100e3, 0.0, 5e3);
    request.surface_spring = crust * standard_gravity;
    request.base_spring = contrast;
    return request;
}

/// Stiffness of the column against shortening, Pa/m: lambda + 2 mu over its height.
double column_stiffness(const fem::FootwallRequest& request) {
    const fem::Layer& rock = request.layers.front();
    const double e = rock.young_modulus, nu = rock.poisson_ratio;
    return e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) / request.depth;
}

constexpr double round_off = 1e-9; // relative: condition of the stiffness

/// All unknowns of the interface are kept.
std::vector<LoadResponse> solve(fem::Footwall& footwall,
                                const std::vector<std::vector<fem::Load>>& effects) {
    return solve_unit_loads(footwall, effects, 2 * footwall.interface().size());
}

SurfaceResponse surface_response(fem::Footwall& footwall, const std::vector<double>& knots) {
    const LoadResponse response = solve(footwall, {surface_loads(knots)}).front();
    return {knots, response.interface, response.sums, response.work.front()};
}

TEST(UnitLoads, AreSplitByEffect) {
    const auto footwall = fem::make_footwall(floating_crust());
    EXPECT_TRUE(solve(*footwall, {{}}).front().work.front().empty());
    const std::vector<fem::Load> one = surface_loads({-50e3, 0.0});
    const std::vector<fem::Load> two = lower_crust_loads({20e3, 50e3, -50e3}, contrast, 10e3);
    const std::vector<LoadResponse> together = solve(*footwall, {one, {}, two});
    const LoadResponse alone = solve(*footwall, {two}).front();
    EXPECT_EQ(together[2].interface, alone.interface);
    EXPECT_EQ(together[2].work[2], alone.work[0]);
    EXPECT_TRUE(together[1].interface.empty() && together[2].work[1].empty());
    ASSERT_EQ(together[0].work[2].size(), two.size() * one.size());
    // Betti: who works on whom does not matter.
    const double largest = std::abs(together[0].work[2].back());
    for (std::size_t i = 0; i < one.size(); ++i)
        for (std::size_t k = 0; k < two.size(); ++k)
            EXPECT_NEAR(together[0].work[2][k * one.size() + i],
                        together[2].work[0][i * two.size() + k], round_off * largest);
}

TEST(LowerCrust, WideThinningIsTheIsostaticColumn) {
    const fem::FootwallRequest request = floating_crust();
    const auto footwall = fem::make_footwall(request);
    const LowerCrustThinningParameters thinning{20e3, 2000e3, 0.0};
    constexpr double distance = 10e3;
    const std::vector<fem::Load> loads = lower_crust_loads(thinning, contrast, distance);
    const LoadResponse response = solve(*footwall, {loads}).front();
    const std::size_t unknowns = 2 * footwall->interface().size();
    ASSERT_EQ(response.interface.size(), loads.size() * unknowns);
    // Thinner by h e / (b + e).
    const double thinner = 20e3 * distance / 2010e3;
    EXPECT_DOUBLE_EQ(lower_crust_thinning(thinning, distance), thinner);
    // Springs at both ends of an elastic column that is pulled at its base.
    const double top = request.surface_spring, base = request.base_spring;
    const double subsidence =
        contrast * thinner / (top + base + top * base / column_stiffness(request));
    for (std::size_t i = 0; i < unknowns; i += 2) {
        const std::size_t last = (loads.size() - 1) * unknowns + i;
        EXPECT_NEAR(response.interface[last], 0.0, round_off * subsidence);
        EXPECT_NEAR(response.interface[last + 1], -subsidence, round_off * subsidence);
    }
    // Airy's, but for what the column gives: 0.2 %.
    EXPECT_NEAR(subsidence / (thinner * (mantle - crust) / mantle), 1.0, 3e-3);
}

/// From 10 km of net shortening to 20 km of extension, at 4 km of shortening: the isostatic column
/// rises by what mantle the thicker crust has replaced. 0.1 s.
TEST(LowerCrust, NetShorteningLiftsTheIsostaticColumn) {
    const fem::FootwallRequest request = floating_crust();
    const auto footwall = fem::make_footwall(request);
    const LowerCrustThinningParameters thinning{20e3, 2000e3, 0.0};
    const LoadResponse response =
        solve(*footwall, {lower_crust_loads(thinning, contrast, 20e3, -10e3)}).front();
    const std::vector<double> at = superpose(lower_crust_amounts(6.0 / 30.0), response.interface);
    const double thicker = 20e3 * 4e3 / 1996e3;
    EXPECT_DOUBLE_EQ(lower_crust_thinning(thinning, -4e3), -thicker);
    const double top = request.surface_spring, base = request.base_spring;
    const double rise = contrast * thicker / (top + base + top * base / column_stiffness(request));
    for (std::size_t i = 1; i < at.size(); i += 2)
        EXPECT_NEAR(at[i], rise, round_off * rise);
}

TEST(LowerCrust, StepsBy25MetresAtAnyRateAndKeepsTheLoadBetween) {
    const auto thinning = [](double rate) {
        return LowerCrustThinning(std::vector<double>(22, 1.0), 100.0, 0.0, rate);
    };
    for (const double rate : {0.0002, 0.001, 0.003, 0.01, 1.0})
        EXPECT_EQ(thinning(rate).schedule().spacing(), 25.0) << rate;
    LowerCrustThinning event = thinning(1.0);
    dem::State state;
    event.begin(state);
    EXPECT_EQ(event.amounts(state), lower_crust_amounts(0.0));
    state.clock.extension.m = 25.0;
    event.apply(state, {});
    state.clock.extension.m = 40.0;
    EXPECT_EQ(event.extension(state), 25.0);
    EXPECT_EQ(event.amounts(state), lower_crust_amounts(0.25));
}

TEST(LowerCrust, LoadIsTheAreaDrawnOut) {
    fem::FootwallRequest request = floating_crust();
    request.left = -200e3;
    request.right = 200e3;
    const auto footwall = fem::make_footwall(request);
    const LowerCrustThinningParameters thinning{20e3, 100e3, 15e3};
    const std::vector<fem::Load> loads = lower_crust_loads(thinning, contrast, 10e3);
    const LoadResponse response = solve(*footwall, {loads}).front();
    // The load ends inside elements; neither its sum nor its moment depends on where.
    for (const double e : {0.7e3, 3e3, 10e3}) {
        fem::Load load = lower_crust_load(thinning, contrast, e);
        footwall->solve(load);
        const double sum = -contrast * 20e3 * e, to = 65e3 + e, from = -35e3;
        EXPECT_NEAR(footwall->total_load().y / sum, 1.0, 1e-12);
        load.traction = [=, vertical = load.traction](fem::Vector p, fem::Vector n,
                                                      fem::Boundary b) {
            return fem::Vector{p.x * vertical(p, n, b).y, 0.0};
        };
        footwall->solve(load);
        EXPECT_NEAR(footwall->total_load().x / (0.5 * (from + to) * sum), 1.0, 1e-12);
    }
    // The interface of a flat layer is its surface: what the springs there hold and those at the
    // base, with the layer rigid enough to move as one over 400 km, is the load. Held by the
    // exact mean: integrate the surface's displacement; the base differs by the layer's own
    // shortening, 1 %.
    const auto& nodes = footwall->interface();
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const std::size_t at = (loads.size() - 1) * 2 * nodes.size() + 2 * k + 1;
        sum += 0.5 * (response.interface[at] + response.interface[at + 2]) *
               (nodes[k + 1].place.x - nodes[k].place.x);
    }
    EXPECT_NEAR(-sum * mantle * standard_gravity / (contrast * 20e3 * 10e3), 1.0, 0.01);
    // In between rows are straight to 1e-3.
    const std::vector<fem::Load> half = {lower_crust_load(thinning, contrast, 5.5e3)};
    const fem::Responses exact = footwall->responses(half);
    const std::vector<double> between = superpose(lower_crust_amounts(0.55), response.interface);
    double largest = 0.0;
    for (double u : exact.interface)
        largest = std::max(largest, std::abs(u));
    for (std::size_t i = 0; i < between.size(); ++i)
        EXPECT_NEAR(between[i], exact.interface[i], 5e-3 * largest);
}

class Erosion : public testing::Test {
protected:
    fem::FootwallRequest request_ = floating_crust();
    std::unique_ptr<fem::Footwall> footwall_ = fem::make_footwall(request_);
    FootwallErosionParameters erosion_ = {};
    SurfaceResponse response_ =
        surface_response(*footwall_, surface_knots(erosion_.width, request_.left));
    std::vector<double> eroded_ = std::vector<double>(response_.x.size(), 0.0);
    std::vector<double> deposited_ = eroded_, target_ = eroded_;
    FootwallCover cover_{eroded_, deposited_};

    /// Uplift of the column for a pressure taken off its top, m/Pa.
    double column_uplift() const {
        const double base = request_.base_spring;
        return 1.0 / (request_.surface_spring + base / (1.0 + base / column_stiffness(request_)));
    }
};

TEST_F(Erosion, EvenErosionReboundsByAirysAmount) {
    ASSERT_EQ(response_.x.front(), request_.left);
    ASSERT_EQ(response_.x.back(), 0.0);
    const std::vector<double> uplift(response_.x.size(), 100.0);
    adapt_footwall(response_, erosion_, standard_gravity, uplift, target_, cover_);
    // Eroded rock rebounds by the share c of its weight: E = 100 + c E.
    const double share = crust * standard_gravity * column_uplift();
    // Within the 0.01 m at which rebound is no longer followed up, over 1 - share.
    for (std::size_t k = 0; k < eroded_.size(); ++k) {
        EXPECT_NEAR(eroded_[k], 100.0 / (1.0 - share), 0.01 / (1.0 - share));
        EXPECT_EQ(deposited_[k], 0.0);
    }
    EXPECT_NEAR(share, crust / mantle, 3e-3); // Airy's, but for what the column gives
    // Forces of the interface for the same: its displacement is the rebound.
    const std::vector<double> pressure = cover_pressure(erosion_, standard_gravity, cover_);
    const std::size_t unknowns = 2 * footwall_->interface().size();
    for (std::size_t i = 1; i < unknowns; i += 2) {
        double u = 0.0;
        for (std::size_t k = 0; k < pressure.size(); ++k)
            u += pressure[k] * response_.interface[k * unknowns + i];
        EXPECT_NEAR(u, share * eroded_.front(), 0.1);
    }
}

/// What heat asks for: height and sediment by x, linear between knots, nothing left of them.
TEST_F(Erosion, TellsWhatLiesOnTheFlank) {
    FootwallErosion erosion(response_, {}, nullptr, erosion_, standard_gravity,
                            dem::Calendar(0.01));
    const auto eroded = erosion.memory.get<double>("eroded");
    const auto deposited = erosion.memory.get<double>("deposited");
    std::ranges::fill(eroded, 100.0);
    for (std::size_t k = 0; k < deposited.size(); ++k)
        deposited[k] = 10.0 * static_cast<double>(k);
    EXPECT_DOUBLE_EQ(erosion.sediment(response_.x[2]), 20.0);
    EXPECT_DOUBLE_EQ(erosion.sediment(0.5 * (response_.x[2] + response_.x[3])), 25.0);
    EXPECT_DOUBLE_EQ(erosion.cover(response_.x[2]), -80.0);
    EXPECT_EQ(erosion.sediment(response_.x[0] - 1.0), 0.0);
    EXPECT_EQ(erosion.cover(response_.x[0] - 1.0), 0.0);
}

TEST_F(Erosion, FillsHollowsAndTakesSedimentFirst) {
    std::vector<double> uplift(response_.x.size(), -100.0);
    adapt_footwall(response_, erosion_, standard_gravity, uplift, target_, cover_);
    const double share = 2300.0 * standard_gravity * column_uplift();
    for (std::size_t k = 0; k < eroded_.size(); ++k) {
        EXPECT_EQ(eroded_[k], 0.0);
        EXPECT_NEAR(deposited_[k], 100.0 / (1.0 - share), 0.01 / (1.0 - share));
    }
    std::ranges::fill(uplift, 0.0);
    adapt_footwall(response_, erosion_, standard_gravity, uplift, target_, cover_);
    for (std::size_t k = 0; k < eroded_.size(); ++k) {
        EXPECT_NEAR(deposited_[k], 0.0, 0.01 / (1.0 - share));
        EXPECT_NEAR(eroded_[k], 0.0, 0.01 / (1.0 - share));
    }
}

TEST_F(Erosion, BringsAnUnevenSurfaceToTheTarget) {
    std::vector<double> uplift;
    for (double x : response_.x) // a flank, its foreland and a target that slopes
        uplift.push_back(500.0 * std::exp(x / 20e3) * std::cos(x / 20e3) - 20.0);
    for (std::size_t k = 0; k < target_.size(); ++k)
        target_[k] = -1e-3 * response_.x[k];
    EXPECT_LT(adapt_footwall(response_, erosion_, standard_gravity, uplift, target_, cover_), 100);
    const std::vector<double> pressure = cover_pressure(erosion_, standard_gravity, cover_);
    const std::size_t n = response_.x.size();
    for (std::size_t k = 0; k < n; ++k) {
        double height = uplift[k] + deposited_[k] - eroded_[k];
        for (std::size_t j = 0; j < n; ++j)
            height += pressure[j] * response_.uplift[j * n + k];
        EXPECT_NEAR(height, target_[k], 0.01);
        EXPECT_TRUE(eroded_[k] >= 0.0 && deposited_[k] >= 0.0);
    }
}

/// A hanging wall of 10 km moves right by 2 km, off a ramp, and sinks by 1 km.
TEST(BasinWater, WeighsOnWhatLiesBelow) {
    Interface interface;
    for (int k = 0; k <= 40; ++k) { // a ramp of 45 degrees and a flat at 2 km
        interface.x.push_back(500.0 * k);
        interface.y.push_back(std::max(-500.0 * k, -2000.0));
    }
    constexpr double r = 50.0, column = 200.0;
    std::vector<Disc> discs; // their tops ten metres below the level: roughness
    for (int k = 0; k < 100; ++k)
        discs.push_back({r + 2.0 * r * k, -r - 10.0, r});
    State state = make_state(discs);
    add_base_nodes(state, interface.x, interface.y);
    const DiscColumns d = disc_columns(state);
    const BaseNodeColumns nodes = base_node_columns(state);
    const BasinWaterParameters parameters{.level = 0.0, .density = 1030.0};
    BasinWater water(interface, parameters, standard_gravity, column, 0.01);
    water.begin(state);
    EXPECT_NEAR(water.memory.get<double>("start_depth_m")[0], 10.0, 1e-9);
    water.apply(state, {});
    EXPECT_NEAR(water_weight(state), 0.0, 1.0);

    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.x[i] += 2000.0;
        d.y[i] -= 1000.0;
    }
    EXPECT_FALSE(water.apply(state, {})); // neighbours are the same
    // Over the ramp 100, 300, ... 1900 m deep but for the roughness, over the hanging wall 1000 m.
    const double area = 2000.0 * (1000.0 - 10.0) + 9800.0 * 1000.0;
    EXPECT_NEAR(water_weight(state), 1030.0 * standard_gravity * area, 1e-9 * water_weight(state));
    // On the flat, on each metre of the detachment what is above it; Simpson's weights.
    const auto load = state.base_memory.at("interface_loads").get<double>("basin_water");
    const double on_a_node = 500.0 * 1030.0 * standard_gravity * 1000.0;
    for (std::size_t k = 6; k < 22; ++k)
        EXPECT_NEAR(load[2 * k + 1], -on_a_node * (k % 2 ? 4.0 : 2.0) / 3.0, 1e-9 * on_a_node) << k;
    for (std::size_t k = 0; k < interface.x.size(); ++k)
        EXPECT_EQ(load[2 * k], 0.0);

    // A ramp that rises leaves less room where no disc lies on it.
    std::ranges::fill(nodes.uy, 500.0);
    water.apply(state, {});
    const double left = column * (200.0 + 400.0 + 600.0 + 800.0 + 1000.0 + 1200.0 + 1400.0 - 70.0);
    EXPECT_NEAR(water_weight(state), 1030.0 * standard_gravity * (left + 9800.0 * 1000.0),
                1e-9 * water_weight(state));
    // Discs that have come up are dry.
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.y[i] += 2000.0;
    std::ranges::fill(nodes.uy, 3000.0);
    water.apply(state, {});
    EXPECT_EQ(water_weight(state), 0.0);
}

TEST(SurfaceResponse, IsTheTransposeOfTheInterfaces) {
    fem::FootwallRequest request;
    request.detachment = listric_detachment();
    request.surface_spring = request.detachment_spring = crust * standard_gravity;
    request.base_spring = contrast;
    request.cell_size = 2000.0;
    request.interface_end = 60e3;
    const auto footwall = fem::make_footwall(request);
    const FootwallErosionParameters erosion;
    const LowerCrustThinningParameters thinning;
    const std::vector<double> at = surface_knots(erosion.width, request.left);
    const LoadResponse found =
        solve(*footwall, {surface_loads(at), lower_crust_loads(thinning, contrast, 10e3)}).front();
    const SurfaceResponse surface(at, found.interface, found.sums, found.work[0]);
    const std::size_t n = surface.x.size();
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j) // round-off
            EXPECT_NEAR(surface.uplift[k * n + j] * surface.width[j],
                        surface.uplift[j * n + k] * surface.width[k],
                        1e-9 * std::abs(surface.uplift[k * n + k]) * surface.width[k]);
    // A knot's uplift is the surface's there, but for the mean over its width.
    const fem::PointForce force{{5e3, -11e3}, {2e11, 8e11}};
    fem::Load load;
    load.interface = footwall->nodal_forces({&force, 1});
    const auto compare = [&](const std::vector<double>& knots) {
        const fem::Field top = row(footwall->field(), 0.0, 1.0);
        double largest = 0.0;
        for (const auto& u : top.displacement)
            largest = std::max(largest, std::abs(u.y));
        for (std::size_t k = 1; k + 1 < n; ++k) {
            std::size_t i = 0;
            while (top.place[i + 1].x < surface.x[k])
                ++i;
            const double share =
                (surface.x[k] - top.place[i].x) / (top.place[i + 1].x - top.place[i].x);
            const double u =
                (1.0 - share) * top.displacement[i].y + share * top.displacement[i + 1].y;
            EXPECT_NEAR(knots[k], u, 0.03 * largest) << surface.x[k];
        }
    };
    footwall->solve(load);
    compare(surface.uplift_by(load.interface));
    footwall->solve(lower_crust_load(thinning, contrast, 10e3));
    compare(superpose(lower_crust_amounts(1.0), surface.uplift_by_work(found.work[1])));
}

TEST(IndependentSolution, IsTheBaseOnAnotherMesh) {
    fem::FootwallRequest request;
    request.detachment = listric_detachment();
    request.surface_spring = request.detachment_spring = crust * standard_gravity;
    request.base_spring = contrast;
    request.elastic_thickness = 10e3;
    request.skin_thickness = 3e3;
    request.cell_size = 2000.0;
    request.interface_end = 60e3;
    const auto footwall = fem::make_footwall(request);
    const Interface interface = condense(*footwall, 2);
    // Like discs: forces at points along the arc and the flat, heavier toward the breakaway.
    std::vector<fem::PointForce> points;
    Random random(3);
    for (double x = 100.0; x < 45e3; x += 300.0) {
        const double y = x < 15e3 ? -std::sqrt(15e3 * 15e3 - (15e3 - x) * (15e3 - x)) : -15e3;
        const double f = 300.0 * 5e7 * std::exp(-x / 15e3) * random.between(0.5, 1.5);
        points.push_back({{x, y}, {0.2 * f, f}});
    }
    const LowerCrustThinningParameters thinning;
    fem::Load load = lower_crust_load(thinning, contrast, 5e3);
    load.interface = footwall->nodal_forces(points);
    footwall->solve(load);
    std::vector<double> u = footwall->interface_displacement(), forces = load.interface;
    forces.resize(interface.unknowns());
    u.resize(interface.unknowns());

    const IndependentSolution fine =
        solve_independently(request, interface, forces, lower_crust_load(thinning, contrast, 5e3));
    const double apart = relative_difference(u, fine.displacement);
    std::printf("%zu unknowns and %zu: %.5f\n", footwall->mesh().unknowns, fine.unknowns, apart);
    EXPECT_GT(fine.unknowns, 2 * footwall->mesh().unknowns);
    EXPECT_LT(apart, 0.01); // discretisation, of forces that change within an element
    EXPECT_GT(apart, 1e-8); // it is another mesh
}

TEST(IndependentSolution, TractionsHaveTheForces) {
    Interface interface;
    for (int k = 0; k <= 20; ++k) {
        interface.x.push_back(500.0 * k);
        interface.y.push_back(-1000.0);
    }
    const std::vector<double> even = pressure_forces(interface, 0.0, 10e3);
    std::vector<double> forces(interface.unknowns(), 0.0);
    for (std::size_t k = 0; k < even.size(); ++k)
        forces[2 * k + 1] = even[k];
    const std::vector<double> pressure = tractions(interface, forces);
    for (std::size_t k = 0; k < interface.x.size(); ++k) {
        EXPECT_NEAR(pressure[2 * k], 0.0, 1e-12); // round-off
        EXPECT_NEAR(pressure[2 * k + 1], 1.0, 1e-12);
    }
}

} // namespace
} // namespace listric::fem_footwall_loads_test
