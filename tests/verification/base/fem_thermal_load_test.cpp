// What temperatures do to a base that bends: McKenzie's columns on a wide one, the flank of a
// narrow rift, and that mass which changes hands is counted by others.

#include "coupling/interface_loads.hpp"
#include "coupling/lower_crust_thinning.hpp"
#include "coupling/thermal_load.hpp"
#include "tests/support.hpp"
#include "tests/verification/footwalls.hpp"
#include "thermal/heat.hpp"
#include "thermal/rift_column.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace listric::fem_thermal_load_test {

using namespace dem;
using namespace coupling;
namespace {

using namespace support;

constexpr double mantle = 3330.0, crust = 2800.0, water = 1000.0; // kg/m^3
constexpr double gravity = standard_gravity;

/// McKenzie's lithosphere: one conductivity and capacity, no heat of its own.
thermal::HeatParameters mckenzie(double thickness_of_crust) {
    thermal::HeatParameters p;
    p.surface_temperature = 0.0;
    p.crust = thickness_of_crust;
    p.conductivity = p.mantle_conductivity = 0.8e-6 * thermal::mantle_capacity;
    p.heat_production = 0.0;
    return p;
}

// ------------------------------------------------------------------------------------- columns

/// Lost mass of a column of mantle that stretches at once or in some time, and rests: rows of 250
/// m, parts of 0.25 Ma.
std::vector<double> lost_by_column(double beta, double years) {
    thermal::RiftColumn column(mckenzie(1.0), {0.0, mantle, mantle});
    const int parts = years > 0.0 ? 40 : 1;
    for (int k = 0; k < parts; ++k) {
        const double before = 1.0 + (beta - 1.0) * k / parts;
        const double now = 1.0 + (beta - 1.0) * (k + 1) / parts;
        column.stretch(now / before, now / before);
        if (years > 0.0)
            column.rest(years / parts * seconds_per_year);
    }
    std::vector<double> lost{column.mass_lost()};
    for (int k = 1; k <= 400; ++k) {
        column.rest(0.25e6 * seconds_per_year);
        if (k == 80 || k == 200 || k == 400)
            lost.push_back(column.mass_lost());
    }
    return lost;
}

/// McKenzie's series under water after 20, 50 and 100 Ma; Jarvis and McKenzie's rifts of 10 Ma.
TEST(RiftColumn, SubsidesAsMcKenzieSays) {
    const auto expect = [](double beta, double years, const std::vector<double>& expected,
                           double tolerance) {
        const std::vector<double> lost = lost_by_column(beta, years);
        for (std::size_t k = 0; k < 3; ++k)
            if (expected[k] > 0.0) {
                EXPECT_NEAR((lost[0] - lost[k + 1]) / (mantle - water) / expected[k], 1.0,
                            tolerance)
                    << beta << ", " << years << ", " << k;
            }
    };
    expect(1.25, 0.0, {240, 448, 631}, 5e-3); // rounded to a metre, first order in time
    expect(1.5, 0.0, {350, 712, 1036}, 5e-3);
    expect(2.0, 0.0, {492, 1045, 1544}, 5e-3);
    expect(1.25, 10e6, {0, 0, 550}, 1e-2);
    expect(2.0, 10e6, {0, 0, 1442}, 1e-2);
}

// ------------------------------------------------------------------------------------ sections

constexpr double radius = 125.0, length = 4e3, depth = 250.0; // of the few discs above a rift

State row_of_discs() {
    State state = empty_state();
    state.mean_radius = radius;
    const auto count = static_cast<std::size_t>(length / (2.0 * radius));
    add_discs(state, count);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < count; ++i) {
        d.x[i] = (2.0 * static_cast<double>(i) + 1.0) * radius;
        d.y[i] = -radius;
        d.radius[i] = radius;
        d.mass[i] = mantle * 4.0 * radius * radius;
    }
    return state;
}

/// A section that stretches at once about the middle of its discs, and rests in steps of 1 Ma.
struct Rift {
    State state = row_of_discs();
    RigidBase base;
    thermal::HeatSetting setting;
    thermal::HeatPoints points;
    thermal::Heat heat;

    Rift(double width, double extension, double thickness_of_crust = depth)
        : setting(make_setting(width, extension)),
          points(mckenzie(thickness_of_crust), setting, schedule(extension)),
          heat(mckenzie(thickness_of_crust), setting, points, schedule(extension)) {
        base.surfaces = {{"floor", {line({0.0, -depth}, {length, -depth})}},
                         {"right wall", {line({length, -depth}, {length, 1e4})}}};
        base.motion.stages = {
            {Travel(0.0), Travel(extension), Extension(0.0), 1.0},
            {Travel(extension), Travel(extension + 1e5), Extension(extension), 0.0}};
        heat.begin(state);
        points.start(state, base);
        heat.start(state, base);
    }

    static thermal::HeatSetting make_setting(double width, double extension) {
        thermal::HeatSetting s;
        s.beside = {0.0, 0.0, length};
        s.greatest_extension = extension;
        s.shear = {-0.5 * width, width, width};
        s.rock_densities = {mantle};
        s.crust_density = s.mantle_density = mantle;
        return s;
    }
    static Schedule schedule(double extension) {
        const SteppedPause pause{Travel(extension), Travel(100.0), 200, 1e6};
        return {1e3, Calendar(extension / 1e3, {pause}), InSteps::once};
    }
    double middle() const { return 0.5 * setting.greatest_extension; }

    void move(Event& event) {
        state.clock.travel = event.next_due();
        state.clock.extension = base.motion.position(state.clock.travel);
        event.apply(state, base);
        ++event.applied;
    }
    void step() {
        move(points);
        move(heat);
    }
    std::vector<double> lost(const std::vector<double>& knots) const {
        return heat.mass_lost(state, base, knots);
    }
};

std::vector<double> every_10_km(double from, double to) {
    std::vector<double> knots;
    for (double x = from; x <= to; x += 10e3)
        knots.push_back(x);
    return knots;
}

/// Knots share cells that are up to 12 km wide: exactly, or neighbours would differ by a third.
TEST(ThermalLoad, IsEvenWhereTheRiftIs) {
    Rift rift(400e3, 400e3);
    for (int k = 0; k < 21; ++k)
        rift.step();
    const std::vector<double> lost = rift.lost(every_10_km(20e3, 380e3));
    const double mean =
        std::accumulate(lost.begin(), lost.end(), 0.0) / static_cast<double>(lost.size());
    double square = 0.0, most = 0.0;
    for (const double one : lost) {
        square += (one / mean - 1.0) * (one / mean - 1.0) / static_cast<double>(lost.size());
        most = std::max(most, std::abs(one / mean - 1.0));
    }
    std::printf("lost mass of 37 knots: rms %.2f %%, at most %.2f %%\n", 100.0 * std::sqrt(square),
                100.0 * most);
    EXPECT_LT(std::sqrt(square), 0.02); // points 12 km by 3 km, in two lattices of rows
    EXPECT_LT(most, 0.05);
}

/// What conserves the load's sum: any knots share it.
TEST(ThermalLoad, HasTheSameSumByAnyKnots) {
    Rift rift(100e3, 50e3);
    for (int k = 0; k < 6; ++k)
        rift.step();
    const double from = -200e3, to = 200e3;
    const std::vector<double> two = rift.lost({from, to});
    const double whole = 0.5 * (two[0] + two[1]) * (to - from);
    for (const int parts : {7, 40, 61}) {
        std::vector<double> knots;
        for (int k = 0; k <= parts; ++k)
            knots.push_back(from + (to - from) * k / parts);
        const std::vector<double> lost = rift.lost(knots);
        double sum = 0.0;
        for (std::size_t k = 1; k < knots.size(); ++k)
            sum += 0.5 * (lost[k - 1] + lost[k]) * (knots[k] - knots[k - 1]);
        EXPECT_NEAR(sum / whole, 1.0, 1e-10) << parts;
    }
}

// ------------------------------------------------------------------------------------- plates

/// A plate of mantle rock under water; below its elastic thickness rock carries no bending.
fem::FootwallRequest plate(double elastic_thickness, double left, double right) {
    fem::FootwallRequest request = layer(elastic_thickness, left, right, 2500.0);
    request.surface_spring = (crust - water) * gravity;
    request.base_spring = (mantle - crust) * gravity;
    return request;
}

/// Subsidence of a plate's surface from a lost mass to another at the knots: places and m.
std::vector<Point> subsidence(const fem::FootwallRequest& request, const std::vector<double>& knots,
                              const std::vector<double>& before, const std::vector<double>& now) {
    const auto footwall = fem::make_footwall(request);
    std::vector<double> pressure;
    for (std::size_t k = 0; k < knots.size(); ++k)
        pressure.push_back(gravity * (before[k] - now[k]));
    footwall->solve(pressure_load(fem::Boundary::base, knots, pressure));
    const fem::Field surface = row(footwall->field(), 0.0, 1.0);
    std::vector<Point> sunk;
    for (std::size_t k = 0; k < surface.place.size(); ++k)
        sunk.push_back({surface.place[k].x, -surface.displacement[k].y});
    return sunk;
}

double at(const std::vector<Point>& line, double x) {
    return std::ranges::min(line, {}, [x](Point p) { return std::abs(p.x - x); }).y;
}

/// Springs at the contrast of what floats and what fills: after 100 Ma of an even load.
TEST(ThermalLoad, WideColumnSinksAsTheOneOfMcKenzie) {
    const std::vector<double> lost = lost_by_column(1.25, 0.0);
    const std::vector<double> knots = every_10_km(-600e3, 600e3);
    const std::vector<double> before(knots.size(), lost[0]), now(knots.size(), lost[3]);
    for (const double thickness : {1e3, 10e3}) { // a plate of 1 km bends by itself
        const double centre =
            at(subsidence(plate(thickness, -600e3, 600e3), knots, before, now), 0.0);
        std::printf("Te %2.0f km: %.1f m, McKenzie 631 m\n", thickness / 1e3, centre);
        EXPECT_NEAR(centre / 631.0, 1.0, 5e-3) << thickness;
    }
}

/// Heat in x and z, and a thin plate on a fluid, against their transforms. Points 6 km apart, 9
/// where they are stretched, put each edge of the rift up to 1.5 km inside: edges are compared with
/// the transform of a rift that is as much narrower (172, 355 and 523 m where they are exact).
TEST(ThermalLoad, ANarrowRiftBendsThePlate) {
    Rift rift(100e3, 50e3);
    const std::vector<double> knots =
        thermal_knots(-50e3, 100e3, -600e3, 600e3); // 100 km beyond both
    rift.step();
    const std::vector<double> before = rift.lost(knots);
    struct Moment {
        int after;           ///< Ma
        double centre, edge; ///< m
    };
    int steps = 0;
    for (const auto& [after, centre, edge] :
         {Moment{20, 458, 156}, Moment{50, 889, 332}, Moment{100, 1203, 495}}) {
        for (; steps < after; ++steps)
            rift.step();
        const std::vector<Point> sunk =
            subsidence(plate(10e3, -600e3, 650e3), knots, before, rift.lost(knots));
        const double left = at(sunk, rift.middle() - 75e3), right = at(sunk, rift.middle() + 75e3);
        std::printf("%3d Ma: centre %.0f m (%.0f), edges %.0f and %.0f m (%.0f)\n", after,
                    at(sunk, rift.middle()), centre, left, right, edge);
        EXPECT_NEAR(at(sunk, rift.middle()) / centre, 1.0, 0.02);
        EXPECT_NEAR(left, edge, 8.0);
        EXPECT_NEAR(right, edge, 8.0);
    }
}

/// Rock that moves with its pure shear and has everywhere the temperature of the start there: all
/// that loads is the mantle in place of crust.
TEST(ThermalLoad, CountsNothingThatTheLowerCrustCounts) {
    Rift rift(100e3, 50e3, 30e3);
    const auto hold = [&] {
        const thermal::HeatCells cells = rift.heat.cells(rift.state);
        const std::size_t discs = rift.state.discs.rows();
        const auto temperature = rift.points.temperature();
        for (std::size_t k = 0; k < temperature.size(); ++k)
            temperature[k] =
                rift.heat.start_temperature({cells.sites.x[discs + k], cells.sites.y[discs + k]});
    };
    const std::vector<double> knots = thermal_knots(-50e3, 100e3, -300e3, 350e3);
    fem::FootwallRequest request = small_footwall();
    request.left = -300e3;
    request.right = 350e3;
    request.interface_end = 60e3;
    const auto footwall = fem::make_footwall(request);
    const ElasticBase base(condense(*footwall, 2), {});
    const LowerCrustThinningParameters thinning{20e3, 100e3, 0.0};
    const auto pressure = [&] {
        std::vector<double> weight = rift.lost(knots);
        for (double& p : weight)
            p *= -gravity;
        return weight;
    };
    const std::vector<FootwallLoad> effects{
        lower_crust_thinning_load(thinning, 600.0 * gravity, 50e3, 0.0, 50.0),
        thermal_load(knots, pressure, Rift::schedule(50e3))};
    std::vector<std::unique_ptr<Event>> events;
    const FootwallLoads loads(*footwall, base, effects, events);
    base.attach(rift.state);
    for (const auto& event : events)
        event->begin(rift.state);
    hold();
    for (const auto& event : events)
        event->start(rift.state, rift.base);
    rift.move(rift.points);
    hold();
    std::vector<double> alone(base.interface().unknowns(), 0.0), both = alone;
    events.front()->apply(rift.state, rift.base);
    add_footwall_loads(rift.state, alone);
    events.back()->apply(rift.state, rift.base);
    add_footwall_loads(rift.state, both);
    double largest = 0.0, difference = 0.0;
    for (std::size_t k = 0; k < both.size(); ++k) {
        largest = std::max(largest, std::abs(alone[k]));
        difference = std::max(difference, std::abs(both[k] - alone[k]));
    }
    EXPECT_GT(largest, 1e6);
    EXPECT_LE(difference, 1e-12 * largest);
    // Hot rock lifts.
    for (double& one : rift.points.temperature())
        one += 10.0;
    events.back()->apply(rift.state, rift.base);
    EXPECT_LT(loads.measures(rift.state).back().second, 0.0);
}

} // namespace
} // namespace listric::fem_thermal_load_test
