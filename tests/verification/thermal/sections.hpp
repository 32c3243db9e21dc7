#pragma once

// Sections of discs or points on which heat flows, for exact solutions.

#include "dem/columns.hpp"
#include "dem/numbers/hash.hpp"
#include "dem/numbers/units.hpp"
#include "dem/state.hpp"
#include "thermal/conduction.hpp"
#include "thermal/ground_line.hpp"
#include "thermal/site_cells.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace listric::support {

constexpr double years = dem::seconds_per_year;

/// Discs of 2600 kg/m^3 of their squares, in rows from 0 m down.
inline dem::State rows_of_discs(double length, double depth, double radius) {
    dem::State state = dem::empty_state();
    state.mean_radius = radius;
    const auto columns = static_cast<int>(length / (2.0 * radius));
    const auto rows = static_cast<int>(depth / (2.0 * radius));
    dem::add_discs(state, static_cast<std::size_t>(columns * rows));
    const dem::DiscColumns d = dem::disc_columns(state);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto i = static_cast<std::size_t>(row * columns + column);
            d.x[i] = (2 * column + 1) * radius;
            d.y[i] = -(2 * row + 1) * radius;
            d.radius[i] = radius;
            d.mass[i] = 2600.0 * 4.0 * radius * radius;
        }
    return state;
}

/// Points in jittered rows in a box whose ground is level at 0.
inline thermal::Sites jittered_rows(double width, double depth, double spacing, double jitter) {
    thermal::Sites sites;
    const auto columns = static_cast<int>(std::lround(width / spacing));
    const auto rows = static_cast<int>(std::lround(depth / spacing));
    const double across = width / columns, down = depth / rows;
    const auto shift = [&](int row, int column, std::uint64_t which) {
        const auto bits = dem::mixed(dem::mixed(static_cast<std::uint64_t>(row) + 1000, which + 1),
                                     static_cast<std::uint64_t>(column));
        return jitter * (static_cast<double>(bits >> 11) * 0x1p-53 - 0.5);
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            sites.add({(column + 0.5 + shift(row, column, 0)) * across,
                       -(row + 0.5 + shift(row, column, 1)) * down},
                      0.3 * spacing, 2.5 * spacing);
    return sites;
}

/// Heat in a section of sites.
struct Section {
    thermal::Sites sites;
    thermal::SectionEnds ends;
    std::vector<double> conductivity, capacity, production, temperature;
    thermal::EndTemperatures kept{0.0, 0.0};
    double in = 0.0; ///< heat through floor and ground and made, J/m

    Section(thermal::Sites all, double width, double depth, double k, double rho_c)
        : sites(std::move(all)), ends{0.0, width, -depth}, conductivity(sites.count(), k),
          production(sites.count(), 0.0), temperature(sites.count(), 0.0) {
        for (const dem::PowerCell& cell : cells().cells)
            capacity.push_back(rho_c * cell.area);
    }

    dem::FacetedCells cells() const {
        const thermal::GroundLine level({{ends.left, 0.0}, {ends.right, 0.0}});
        return cut_cells(sites, ends, level, {}).faceted;
    }
    /// @param blanket  resistance of what lies on the ground, m^2 K/W
    thermal::HeatNetwork network(double blanket = 0.0) const {
        return heat_network(sites, cells(), conductivity,
                            std::vector<double>(sites.count(), blanket));
    }
    double stored() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < temperature.size(); ++i)
            sum += capacity[i] * temperature[i];
        return sum;
    }
    thermal::HeatFlows step(const thermal::HeatNetwork& network, double time) {
        const auto flows = conduct(network, capacity, production, kept, time * years, temperature);
        in += flows.produced + flows.through_floor - flows.through_ground;
        return flows;
    }
    void set(const std::function<double(dem::Point)>& field) {
        for (std::size_t i = 0; i < temperature.size(); ++i)
            temperature[i] = field({sites.x[i], sites.y[i]});
    }
    /// Root of the mean square error.
    double error(const std::function<double(dem::Point)>& field) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < temperature.size(); ++i)
            sum += std::pow(temperature[i] - field({sites.x[i], sites.y[i]}), 2);
        return std::sqrt(sum / static_cast<double>(temperature.size()));
    }
};

} // namespace listric::support
