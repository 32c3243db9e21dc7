#pragma once

#include "dem/contacts/power_cell.hpp"
#include "dem/numbers/units.hpp"
#include "thermal/site_cells.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::thermal {

/// Two cells that heat flows between.
struct HeatLink {
    std::int32_t first, second;
    double conductance; ///< W/m/K
};

/// How heat gets from cell to cell and out, by cell where it is not a list; W/m/K.
struct HeatNetwork {
    std::vector<HeatLink> links;
    std::vector<double> ground, floor; ///< 0: it does not touch it
};

/// Conductance of a facet is its length over the resistance of the way through it from centre to
/// centre: exact for a linear field, and within 6 K of 444 across a contact of 1 to 10.
/// @param conductivity  by cell, W/m/K
/// @param blanket       resistance of what lies on the ground above a cell, m^2 K/W; none: nothing
HeatNetwork heat_network(const Sites& sites, const dem::FacetedCells& cells,
                         std::span<const double> conductivity,
                         std::span<const double> blanket = {});

/// Temperatures that the section's ends are kept at, degrees Celsius.
struct EndTemperatures {
    double ground, floor;
};

/// Heat that came in a step, J/m.
struct HeatFlows {
    double produced = 0.0, through_floor = 0.0, through_ground = 0.0; ///< the last: left
};

/// Temperatures after a time, s, by backward Euler in equal parts of at most `longest_part`, or 400
/// parts: exact in its sums, without overshoot whatever the time, and first order. A part of 1 Ma
/// would have subsidence after rifting 0.7 % late at 20 Ma. (Crank-Nicolson leaves 45 K of noise
/// where 3 km are eroded at once.)
/// A direct solver up to 50,000 cells, conjugate gradients beyond.
/// @param capacity    by cell, J/m/K
/// @param production  by cell, W/m
HeatFlows conduct(const HeatNetwork& network, std::span<const double> capacity,
                  std::span<const double> production, const EndTemperatures& ends, double seconds,
                  std::span<double> temperature);

inline constexpr double longest_part = 0.25e6 * dem::seconds_per_year;
inline constexpr std::size_t most_direct = 50000; ///< unknowns of the direct solver

/// Solves by conjugate gradients, to 1e-14 of the right side. @param solution  first guess
void solve_iteratively(std::span<const HeatLink> links, std::span<const double> diagonal,
                       std::span<const double> right_side, std::span<double> solution);

} // namespace listric::thermal
