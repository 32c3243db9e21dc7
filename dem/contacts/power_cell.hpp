#pragma once

#include "dem/base.hpp"
#include "dem/contacts/power_polygon.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Power cells of the discs of the given rows, from the discs within five mean radii. Weakened
/// discs count with the radius of the rock that they stand for: their enlargement is a spring's
/// travel, and would take area from their sound neighbours.
std::vector<PowerCell> power_cells(const State& state, const RigidBase& base,
                                   std::span<const std::int32_t> rows);

/// Side of a power cell.
struct PowerFacet {
    /// Row of the disc beyond it; or one of facet_on_base, facet_open, facet_on_lid.
    std::int32_t neighbour = 0;
    double length = 0.0;   ///< m
    double distance = 0.0; ///< to the neighbour's centre, or to the line of base or lid, m
    Point arm;             ///< from the disc's centre to the middle of the facet, m
};

/// Power cells with their facets: those of cell k are facets[begin[k]] to facets[begin[k + 1]].
struct FacetedCells {
    std::vector<PowerCell> cells;
    std::vector<PowerFacet> facets;
    std::vector<std::size_t> begin;

    std::span<const PowerFacet> of(std::size_t k) const {
        return std::span(facets).subspan(begin[k], begin[k + 1] - begin[k]);
    }
};

/// Faceted cells of some discs, one after the other, which are cut apart from those of others.
struct FacetedPiece {
    std::vector<PowerCell> cells;
    std::vector<PowerFacet> facets;
    std::vector<std::size_t> counts; ///< of facets, by cell

    /// Adds the cell of the disc i of those at x and y, m: this polygon about it.
    void add(const PowerPolygon& polygon, std::size_t i, std::span<const double> x,
             std::span<const double> y);
};
FacetedCells joined_cells(const std::vector<FacetedPiece>& pieces); ///< in their order

/// Power cells and their facets, with neighbours in the order of their distance. Bits of an area
/// may differ from those of power_cells(), which cuts in another order.
/// @param lids  by cell: height above the disc's centre at which a horizontal line ends the cell,
///              m; not finite: none does
FacetedCells faceted_cells(const State& state, const RigidBase& base,
                           std::span<const std::int32_t> rows, std::span<const double> lids);

/// Radius of the rock that each disc stands for, m.
std::vector<double> rock_radii(const State& state);

} // namespace listric::dem
