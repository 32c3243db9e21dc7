// Heat in sections of cells against exact solutions. Balances close to round-off in all of them.

#include "tests/verification/settled_packing.hpp"
#include "tests/verification/thermal/sections.hpp"
#include "thermal/geotherm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace listric::conduction_test {

using namespace support;
using thermal::Sites;
namespace {

constexpr double pi = std::numbers::pi, long_ago = 1e13; // a

/// The balance of a section that began with some heat.
void expect_balance(const Section& section, double before) {
    EXPECT_NEAR((section.stored() - before - section.in) /
                    (std::abs(before) + std::abs(section.in)),
                0.0, 1e-10);
}

/// A packing that genesis has settled, and rows of points below it.
Sites packing_over_points(double width, double depth, double radius) {
    const State state = settled(packing_request(width, 0.5 * depth, radius));
    const ConstDiscColumns d = disc_columns(state);
    Sites sites;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        // Discs that stand up to their middle out of ground taken as level would feel it.
        if (d.y[i] < -0.5 * d.radius[i])
            sites.add({d.x[i], d.y[i]}, d.radius[i], 5.0 * radius);
    const Sites below = jittered_rows(width, 0.5 * depth, 3.0 * radius, 0.3);
    for (std::size_t k = 0; k < below.count(); ++k)
        sites.add({below.x[k], below.y[k] - 0.5 * depth}, radius, below.reach[k]);
    return sites;
}

TEST(Conduction, ALinearFieldIsExact) {
    constexpr double width = 6e3, depth = 8e3, gradient = 0.024;
    Section section(packing_over_points(width, depth, 93.1), width, depth, 2.5, 2.7e6);
    section.kept = {10.0, 10.0 + gradient * depth};
    section.set([](dem::Point p) { return 10.0 - gradient * p.y; });
    const auto linear = [](dem::Point p) { return 10.0 - gradient * p.y; };
    const double before = section.stored();
    const auto network = section.network();
    for (int k = 0; k < 3; ++k)
        section.step(network, 50e3);
    for (std::size_t i = 0; i < section.sites.count(); ++i)
        EXPECT_NEAR(section.temperature[i], linear({section.sites.x[i], section.sites.y[i]}),
                    1e-9); // round-off
    expect_balance(section, before);
}

// Rock of a flank that has sunk below what covers it has no points for as far as it has sunk.
TEST(Conduction, ALinearFieldIsExactFarBelowTheGround) {
    constexpr double width = 6e3, depth = 8e3, gradient = 0.024, cover = 2e3;
    const Sites all = jittered_rows(width, depth, 500.0, 0.3);
    Sites sites;
    for (std::size_t k = 0; k < all.count(); ++k)
        if (all.y[k] < -cover)
            sites.add({all.x[k], all.y[k]}, all.radius[k], all.reach[k]);
    Section section(std::move(sites), width, depth, 2.5, 2.7e6);
    section.kept = {10.0, 10.0 + gradient * depth};
    const auto linear = [](dem::Point p) { return 10.0 - gradient * p.y; };
    section.set(linear);
    const auto network = section.network();
    for (int k = 0; k < 3; ++k)
        section.step(network, 50e3);
    for (std::size_t i = 0; i < section.sites.count(); ++i)
        EXPECT_NEAR(section.temperature[i], linear({section.sites.x[i], section.sites.y[i]}),
                    1e-9); // round-off
}

// What spoils it are heat sources in the middles of cells, which rows of 300 m resolve.
TEST(Conduction, TheSteadyColumnWithRadiogenicHeat) {
    const thermal::HeatParameters p;
    const thermal::Geotherm geotherm(p);
    EXPECT_NEAR(1e3 * geotherm.surface_heat_flow(), 58.0, 0.05);
    EXPECT_NEAR(geotherm.at(10e3), 222.0, 0.5);
    EXPECT_NEAR(geotherm.at(15e3), 313.0, 0.5);
    EXPECT_NEAR(geotherm.at(30e3), 526.0, 0.5);
    EXPECT_NEAR(*geotherm.depth_of(300.0), 14.3e3, 0.1e3);
    EXPECT_NEAR(geotherm.at(p.lithosphere), p.base_temperature, 1e-9);
    constexpr double width = 6e3;
    Section section(jittered_rows(width, p.lithosphere, 500.0, 0.0), width, p.lithosphere,
                    p.conductivity, 2.7e6);
    const auto cells = section.cells();
    for (std::size_t i = 0; i < section.sites.count(); ++i)
        if (section.sites.y[i] > -p.crust)
            section.production[i] = p.heat_production * cells.cells[i].area;
        else
            section.conductivity[i] = p.mantle_conductivity;
    section.kept = {p.surface_temperature, p.base_temperature};
    const auto flows = section.step(section.network(), long_ago);
    const auto exact = [&](dem::Point point) { return geotherm.at(-point.y); };
    EXPECT_LT(section.error(exact), 0.1);
    EXPECT_NEAR(flows.through_ground / (long_ago * years * width), geotherm.surface_heat_flow(),
                1e-5);
}

/// 3 km of 0.5 W/m/K over 5, with 60 mW/m2 from below: root of the mean square error of
/// temperature, and the error of the heat flow, mW/m2.
std::pair<double, double> errors_of_contrast(double radius) {
    constexpr double width = 8e3, depth = 10e3, contact = 3e3, flow = 0.06;
    Section section(packing_over_points(width, 2.0 * depth, radius), width, 2.0 * depth, 5.0,
                    2.7e6);
    for (std::size_t i = 0; i < section.sites.count(); ++i)
        if (section.sites.y[i] > -contact)
            section.conductivity[i] = 0.5;
    const auto exact = [=](dem::Point p) {
        const double z = -p.y;
        return flow * (std::min(z, contact) / 0.5 + std::max(0.0, z - contact) / 5.0);
    };
    section.kept = {0.0, exact({0.0, -2.0 * depth})};
    const auto flows = section.step(section.network(), long_ago);
    return {section.error(exact), 1e3 * (flows.through_ground / (long_ago * years * width) - flow)};
}

// The contact lies between the discs, a part of a diameter from where it should.
TEST(Conduction, AContrastOfTen) {
    const auto [fine, fine_flow] = errors_of_contrast(93.1);
    const auto [coarse, coarse_flow] = errors_of_contrast(186.2);
    EXPECT_LT(fine, 1.5);
    EXPECT_LT(coarse, 8.0);
    EXPECT_NEAR(fine_flow, 0.0, 0.3);
}

// Sediment without discs: it takes no time to warm, however thin it is.
TEST(Conduction, AFilmOfTenTimesLessConductivity) {
    constexpr double width = 3e3, depth = 10e3, k = 2.5, floor = 250.0;
    Section section(jittered_rows(width, depth, 300.0, 0.3), width, depth, k, 2.7e6);
    section.kept = {0.0, floor};
    const auto flow = [&](double film) {
        section.set([](dem::Point p) { return 0.025 * -p.y; });
        const auto flows = section.step(section.network(film / (0.1 * k)), long_ago);
        return 1e3 * flows.through_ground / (long_ago * years * width);
    };
    EXPECT_NEAR(flow(0.0), 62.5, 1e-6);
    EXPECT_NEAR(flow(1.0), 62.5 / (1.0 + 10.0 * 1.0 / depth), 1e-6); // 0.1 % of none
    EXPECT_NEAR(flow(20.0), 62.5 / (1.0 + 10.0 * 20.0 / depth), 1e-6);
    EXPECT_NEAR(section.error([](dem::Point p) { return 0.025 * (200.0 - p.y) / 1.02; }), 0.0,
                1e-6);
}

// Backward Euler of 1/200 of the decay is 0.25 % late, rows of 1/25 of the depth 0.1 %.
TEST(Conduction, AWaveDecays) {
    constexpr double depth = 125e3, kappa = 0.8e-6, rho_c = 4.1e6;
    for (const auto& wave_and_time : {std::pair{100e3, 8.65}, std::pair{200e3, 24.5}}) {
        const double wave = wave_and_time.first, expected = wave_and_time.second;
        const double width = wave;
        Section section(jittered_rows(width, depth, 2.5e3, 0.4), width, depth, kappa * rho_c,
                        rho_c);
        const auto mode = [&](dem::Point p) {
            return std::cos(2.0 * pi * p.x / wave) * std::sin(-pi * p.y / depth);
        };
        section.set(mode);
        const auto amplitude = [&] {
            double sum = 0.0, square = 0.0;
            for (std::size_t i = 0; i < section.sites.count(); ++i) {
                const double m = mode({section.sites.x[i], section.sites.y[i]});
                sum += section.capacity[i] * m * section.temperature[i];
                square += section.capacity[i] * m * m;
            }
            return sum / square;
        };
        const auto network = section.network();
        constexpr int steps = 200;
        for (int k = 0; k < steps; ++k)
            section.step(network, expected * 1e6 / steps);
        EXPECT_NEAR(-1.0 / std::log(amplitude()), 1.0, 0.01) << wave;
    }
}

// Rows of 250 m near the ground; steps grow from 10 ka. 1 + h / sqrt(pi kappa t).
TEST(Conduction, HeatFlowAfterErosionAtOnce) {
    constexpr double depth = 125e3, kappa = 1e-6, rho_c = 2.5e6, gradient = 0.024, eroded = 3e3;
    Sites sites;
    double y = 0.0;
    for (double height = 250.0; y > -depth; height = std::min(1.04 * height, 4e3)) {
        sites.add({500.0, y - 0.5 * height}, 0.25 * height, 2.5 * height);
        y -= height;
    }
    Section section(sites, 1e3, -y, kappa * rho_c, rho_c);
    section.set([](dem::Point p) { return gradient * (eroded - p.y); });
    section.kept = {0.0, gradient * (eroded - y)};
    const double before = section.stored();
    const auto network = section.network();
    double time = 0.0;
    for (const auto& [until, expected] :
         {std::pair{1e6, 1.301}, std::pair{5e6, 1.135}, std::pair{20e6, 1.067}}) {
        double flow = 0.0;
        while (time < until - 1.0) {
            const double step = std::min({until - time, 10e3 + 0.02 * time, 0.2e6});
            flow = section.step(network, step).through_ground / (step * years * 1e3);
            time += step;
        }
        EXPECT_NEAR(flow / (kappa * rho_c * gradient) / expected, 1.0, 0.02) << until;
    }
    expect_balance(section, before);
}

/// Heat flow over that at the start where sediment of the same rock comes in rows of `layer`, m, at
/// a rate, m/a, and the column is carried down.
double flow_under_sediment(double rate, double time, double layer) {
    constexpr double depth = 125e3, kappa = 1e-6, rho_c = 2.5e6, gradient = 0.024, width = 1e3;
    const double most = rate * time;
    std::vector<double> y, height, temperature;
    for (double top = 0.0, h = layer; top < depth; top += h, h = std::min(1.04 * h, 4e3)) {
        y.push_back(-top - 0.5 * h);
        height.push_back(h);
        temperature.push_back(gradient * (top + 0.5 * h));
    }
    const double bottom = -y.back() + 0.5 * height.back(), step = layer / rate;
    double flow = 0.0;
    const auto count = static_cast<int>(std::lround(most / layer));
    for (int k = 0; k < count; ++k) {
        for (double& place : y)
            place -= layer;
        y.insert(y.begin(), -0.5 * layer);
        height.insert(height.begin(), layer);
        temperature.insert(temperature.begin(), 0.0);
        Sites sites;
        for (std::size_t i = 0; i < y.size(); ++i)
            sites.add({0.5 * width, y[i]}, 0.25 * height[i], 2.5 * height[i]);
        Section section(sites, width, bottom + (k + 1) * layer, kappa * rho_c, rho_c);
        section.temperature = temperature;
        section.kept = {0.0, gradient * bottom};
        const auto network = section.network();
        const auto flows = section.step(network, step);
        flow = flows.through_ground / (step * years * width * kappa * rho_c * gradient);
        temperature = section.temperature;
    }
    return flow;
}

// (1 + 2 y^2) erfc y - 2 y exp(-y^2) / sqrt(pi), y = v sqrt(t) / (2 sqrt kappa): 0.8144 at 1 Ma...
TEST(Conduction, HeatFlowUnderSediment) {
    EXPECT_NEAR(flow_under_sediment(1e-3, 1e6, 50.0), 0.8144, 0.005 * 0.8144);
    EXPECT_NEAR(flow_under_sediment(1e-3, 5e6, 50.0), 0.6242, 0.005 * 0.6242);
    EXPECT_NEAR(flow_under_sediment(0.1e-3, 10e6, 50.0), 0.9380, 0.005 * 0.9380);
}

/// The same with discs of a settled packing that come one by one, as the ground rises over them:
/// mean over the time in which it rises by a diameter.
double flow_under_discs(double rate, double time, double radius) {
    constexpr double depth = 60e3, kappa = 1e-6, rho_c = 2.5e6, gradient = 0.024, width = 4e3;
    constexpr double step = 25e3; // a
    const double most = rate * time;
    const State state = settled(packing_request(width, most + 4.0 * radius, radius));
    const ConstDiscColumns d = disc_columns(state);
    const double floor = -most - 4.0 * radius,
                 of_disc = width * -floor / static_cast<double>(d.x.size());
    Sites sites;
    std::vector<double> temperature, area;
    for (double top = 0.0, h = 2.0 * radius; top < depth; top += h, h = std::min(1.05 * h, 4e3)) {
        const double columns = std::max(1.0, std::round(width / h));
        for (double column = 0.0; column < columns; ++column) {
            sites.add({(column + 0.5) * width / columns, floor - top - 0.5 * h}, radius, 2.5 * h);
            temperature.push_back(gradient * (top + 0.5 * h));
            area.push_back(h * width / columns);
        }
    }
    const double bottom = temperature.back() / gradient + 0.5 * area.back() / width;
    std::vector<bool> is_there(d.x.size(), false);
    const auto steps = std::lround(time / step), last = std::lround(2.0 * radius / rate / step);
    double flow = 0.0;
    for (long k = 1; k <= steps; ++k) {
        const double ground = floor + rate * step * static_cast<double>(k);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (!is_there[i] && d.y[i] < ground - 0.5 * radius) {
                is_there[i] = true;
                sites.add({d.x[i], d.y[i]}, d.radius[i], 5.0 * radius);
                temperature.push_back(0.0);
                area.push_back(of_disc);
            }
        Sites below_ground = sites;
        for (double& y : below_ground.y)
            y -= ground;
        Section section(below_ground, width, bottom + ground - floor, kappa * rho_c, rho_c);
        std::ranges::transform(area, section.capacity.begin(), [](double a) { return rho_c * a; });
        section.temperature = temperature;
        section.kept = {0.0, gradient * bottom};
        const auto flows = section.step(section.network(), step);
        if (k > steps - last)
            flow += flows.through_ground / static_cast<double>(last);
        temperature = section.temperature;
    }
    return flow / (step * years * width * kappa * rho_c * gradient);
}

// 1 % is too much at 1 Ma, 0.4 and 0.3 % later: ground that is smoother than discs.
TEST(Conduction, HeatFlowUnderDiscs) {
    EXPECT_NEAR(flow_under_discs(1e-3, 1e6, 93.1) / 0.8144, 1.0, 0.03);
    EXPECT_NEAR(flow_under_discs(1e-3, 5e6, 93.1) / 0.6242, 1.0, 0.03);
    EXPECT_NEAR(flow_under_discs(0.1e-3, 10e6, 93.1) / 0.9380, 1.0, 0.03);
}

/// Heat flow over that of rock alone through a cover of a tenth of its conductivity.
double flow_under_cover(double thickness) {
    constexpr double depth = 10e3, width = 200.0;
    Sites sites;
    if (thickness > 0.0)
        sites.add({0.5 * width, -0.5 * thickness}, 0.5 * thickness, width);
    const std::size_t of_cover = sites.count();
    for (double top = thickness; top < depth + thickness; top += 100.0)
        sites.add({0.5 * width, -top - 50.0}, 50.0, 250.0);
    Section section(sites, width, depth + thickness, 2.5, 2.7e6);
    std::fill_n(section.conductivity.begin(), of_cover, 0.25);
    section.kept = {0.0, 300.0};
    return section.step(section.network(), long_ago).through_ground / (long_ago * years * width) /
           (2.5 * 300.0 / depth);
}

// Resistances in a row; contacts are where the power of both cells is.
TEST(Conduction, AFilmAtTheGround) {
    for (const double thickness : {20.0, 1.0})
        EXPECT_NEAR(flow_under_cover(thickness), 1.0 / (1.0 + 10.0 * thickness / 10e3), 1e-5);
}

/// The hottest 14 km of a column go at once, or in a million years: no heat comes in through the
/// ground, and nothing gets hotter than it was.
TEST(Conduction, ErosionDownTo300Degrees) {
    constexpr double depth = 125e3, gradient = 0.021, eroded = 14.2e3;
    for (const int parts : {1, 20}) {
        std::vector<double> y, height, temperature;
        for (double top = 0.0, h = 200.0; top < depth; top += h, h = std::min(1.03 * h, 4e3)) {
            y.push_back(-top - 0.5 * h);
            height.push_back(h);
            temperature.push_back(gradient * (top + 0.5 * h));
        }
        double bottom = -y.back() + 0.5 * height.back(), least_flow = 1e300;
        const double kept = gradient * bottom;
        for (int step = 0; step < 60; ++step) {
            const double way = step < parts ? eroded / parts : 0.0;
            bottom -= way;
            Sites sites;
            std::vector<double> warm;
            for (std::size_t i = 0; i < y.size(); ++i) {
                y[i] += way;
                if (y[i] >= 0.0)
                    continue;
                sites.add({500.0, y[i]}, 0.25 * height[i], 2.5 * height[i]);
                warm.push_back(temperature[i]);
            }
            y = sites.y;
            height.erase(height.begin(), height.end() - static_cast<std::ptrdiff_t>(y.size()));
            Section section(sites, 1e3, bottom, 2.5, 2.7e6);
            section.temperature = warm;
            section.kept = {0.0, kept};
            least_flow = std::min(least_flow, section.step(section.network(), 50e3).through_ground);
            temperature = section.temperature;
            for (std::size_t i = 0; i < warm.size(); ++i) {
                EXPECT_LE(temperature[i], warm[i] + 1e-9);
                EXPECT_GE(temperature[i], 0.0);
            }
        }
        EXPECT_GT(least_flow, 0.0);
    }
}

/// Two blocks, the right of which sinks along a vertical fault, filled with sediment of the same
/// rock: a section of cells that move, and temperatures of a grid whose rows move by one.
constexpr double fault_x = 5e3, fault_width = 10e3, fault_depth = 24e3, fault_gradient = 0.024;

/// Temperatures by cell of a grid after a throw of whole cells, with steps of `parts` to half a
/// cell: a cell moves in the middle of its time.
std::vector<double> throw_of_grid(double cell, int rows_down, double rate, int parts) {
    const auto columns = static_cast<int>(std::lround(fault_width / cell));
    const auto rows = static_cast<int>(std::lround(fault_depth / cell));
    Section section(jittered_rows(fault_width, fault_depth, cell, 0.0), fault_width, fault_depth,
                    2.5, 2.5e6);
    section.kept = {0.0, fault_gradient * fault_depth};
    section.set([](dem::Point p) { return -fault_gradient * p.y; });
    const auto network = section.network();
    std::vector<double>& t = section.temperature;
    const auto conduct_half = [&] {
        for (int part = 0; part < parts; ++part)
            section.step(network, 0.5 * cell / rate / parts);
    };
    for (int k = 0; k < rows_down; ++k) {
        conduct_half();
        for (int row = rows - 1; row >= 0; --row)
            for (int column = columns / 2; column < columns; ++column)
                t[static_cast<std::size_t>(row * columns + column)] =
                    row > 0 ? t[static_cast<std::size_t>((row - 1) * columns + column)] : 0.0;
        conduct_half();
    }
    return t;
}

// Cells across a slipping fault share the facets that they have at the moment. The error against
// the grid is that of irregular cells, and of sediment that comes a row at a time.
TEST(Conduction, AFaultThatSlips) {
    constexpr double cell = 200.0, spacing = 300.0, rate = 1e-3, step = 50e3, most = 3e3;
    const std::vector<double> exact = throw_of_grid(cell, 15, rate, 2);
    const auto columns = static_cast<int>(std::lround(fault_width / cell));
    const auto rows = static_cast<int>(std::lround(fault_depth / cell));
    Sites sites = jittered_rows(fault_x, fault_depth, spacing, 0.4);
    const Sites right = jittered_rows(fault_width - fault_x, fault_depth, spacing, 0.4);
    for (std::size_t k = 0; k < right.count(); ++k)
        sites.add({fault_x + right.x[k], right.y[k]}, 0.3 * spacing, 2.5 * spacing);
    std::vector<double> t;
    for (const double y : sites.y)
        t.push_back(-fault_gradient * y);
    double room = 0.0; // above the right block
    int strata = 0;
    for (double way = 0.0; way < most - 1.0; way += rate * step) {
        Sites moved;
        std::vector<double> kept;
        const auto keep = [&](dem::Point p, double temperature) {
            moved.add(p, 0.3 * spacing, 2.5 * spacing);
            kept.push_back(temperature);
        };
        for (std::size_t i = 0; i < t.size(); ++i)
            if (const double sunk = sites.x[i] > fault_x ? rate * step : 0.0;
                sites.y[i] - sunk > -fault_depth)
                keep({sites.x[i], sites.y[i] - sunk}, t[i]);
        room += rate * step;
        if (room > spacing - 1.0) {
            const Sites stratum = jittered_rows(fault_width - fault_x, spacing, spacing, 0.4);
            for (std::size_t k = 0; k < stratum.count(); ++k)
                keep({fault_x + stratum.x[k], stratum.y[k]}, 0.0);
            room -= spacing;
            ++strata;
        }
        Section section(moved, fault_width, fault_depth, 2.5, 2.5e6);
        section.kept = {0.0, fault_gradient * fault_depth};
        section.temperature = kept;
        section.step(section.network(), step);
        sites = section.sites;
        t = section.temperature;
    }
    EXPECT_EQ(strata, 10);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i) {
        const double u = sites.x[i] / cell - 0.5, v = -sites.y[i] / cell - 0.5;
        const int c = std::clamp(static_cast<int>(u), 0, columns - 2);
        const int r = std::clamp(static_cast<int>(v), 0, rows - 2);
        const auto at = [&](int row, int column) {
            return exact[static_cast<std::size_t>(row * columns + column)];
        };
        const double there = std::lerp(std::lerp(at(r, c), at(r, c + 1), u - c),
                                       std::lerp(at(r + 1, c), at(r + 1, c + 1), u - c), v - r);
        if (there > 350.0)
            continue;
        sum += std::pow(t[i] - there, 2);
        count += 1.0;
    }
    EXPECT_LT(std::sqrt(sum / count), 0.3);
}

/// Beyond the direct solver's reach.
TEST(Conduction, ConjugateGradientsAreTheDirectSolver) {
    Section section(jittered_rows(10e3, 10e3, 250.0, 0.4), 10e3, 10e3, 2.5, 2.7e6);
    section.set([](dem::Point p) { return -0.03 * p.y + 20.0 * std::sin(p.x); });
    const auto network = section.network();
    std::vector<double> diagonal = section.capacity, right_side;
    for (double& d : diagonal)
        d /= 50e3 * years;
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
        right_side.push_back(diagonal[i] * section.temperature[i]);
        diagonal[i] += network.ground[i] + network.floor[i];
    }
    for (const auto& link : network.links) {
        diagonal[static_cast<std::size_t>(link.first)] += link.conductance;
        diagonal[static_cast<std::size_t>(link.second)] += link.conductance;
    }
    std::vector<double> iterated = section.temperature;
    solve_iteratively(network.links, diagonal, right_side, iterated);
    section.step(network, 50e3);
    for (std::size_t i = 0; i < iterated.size(); ++i)
        EXPECT_NEAR(iterated[i], section.temperature[i], 1e-9);
}

} // namespace
} // namespace listric::conduction_test
