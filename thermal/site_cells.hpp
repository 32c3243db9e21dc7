#pragma once

#include "dem/contacts/power_cell.hpp"
#include "thermal/ground_line.hpp"

#include <span>
#include <vector>

namespace listric::thermal {

/// Places that have a cell of the section: discs, and points in the rock without discs.
struct Sites {
    std::vector<double> x, y, radius;
    std::vector<double> reach; ///< about twice the distance to its neighbours, m

    std::size_t count() const { return x.size(); }
    void add(dem::Point p, double disc_radius, double its_reach);
};

/// Ends of the section, m.
struct SectionEnds {
    double left, right, floor;
};

/// Part of a cell between two vertical lines.
struct CellPart {
    std::size_t cell, strip; ///< strip k is between lines k and k + 1
    double area;             ///< m^2
    double x;                ///< of its centre of area, m
};

struct CutCells {
    dem::FacetedCells faceted;
    std::vector<CellPart> parts; ///< between the lines
};

/// Power cells of the sites, which fill the section below the ground, whole and cut by vertical
/// lines whose x ascends. No gap is left out, and no fault and no base cuts them: rock and sediment
/// touch each other there.
///
/// A cell ends at the line that the ground is where it is nearest, at least half a radius from its
/// centre, for the ground is smoother than the discs (facet_on_lid); on the section's floor
/// (facet_on_base) and at its sides (facet_open).
CutCells cut_cells(const Sites& sites, const SectionEnds& ends, const GroundLine& ground,
                   std::span<const double> lines);

} // namespace listric::thermal
