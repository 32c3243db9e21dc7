#pragma once

#include "fluid/pore_cells.hpp"
#include "fluid/pore_flow.hpp"
#include "fluid/pore_law.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace listric::fluid {

/// Beds of the cells, where water flows along them as it does not across them.
struct Bedding {
    std::vector<double> ratios = {};      ///< by cell: permeability along bedding over that across
    std::vector<dem::Point> normals = {}; ///< by cell, of length 1; empty where all ratios are 1

    bool matters() const { return !normals.empty(); }
    /// The least permeability in any direction over that across.
    double least(std::size_t cell) const;
    /// What the other direction has beyond that, and which one it is.
    double beyond(std::size_t cell) const;
    dem::Point axis(std::size_t cell) const;
    /// Gradient by which as much flows across as by the given one along and across.
    dem::Point flow_of(std::size_t cell, dem::Point gradient) const;
};

/// Dips scatter by some 4 degrees where strata are as thick as discs, so that beds leak across:
/// through level ones flows 1.03, 1.08, 1.23 and 3.6 times what should at ratios of 100, 1000, 1e4
/// and 1e6. Above this ratio it is more than a quarter.
inline constexpr double greatest_tight_ratio = 1e4;

/// The beds are where sediment is equally old, and where rock was equally high at the start: by the
/// plane through the ages, or heights, of a cell and its
/// neighbours, three times mean of the cell's and its neighbours', since discs of a stratum lie up
/// to a diameter above each other. Level where they are too few.
Bedding bedding(const dem::State& state, const PoreCells& cells, std::vector<double> ratios);

/// Links between cells that share a facet, and drains through the ground.
///
/// One number per facet is exact for permeability that is equal in all directions. What the other
/// direction has beyond the least one is added as an energy, half of A k (gradient along it)^2 by
/// cell: links between all neighbours of a cell, of either sign, symmetric, exact where pressure is
/// linear.
/// @param permeability  by cell across bedding, m^2
/// @param viscosity     of the fluid, Pa s
/// @param faults        by cell; empty: none matter
FlowNetwork flow_network(const dem::State& state, const PoreCells& cells,
                         std::span<const double> permeability, double viscosity,
                         std::span<const FaultFactors> faults = {}, const Bedding& beds = {});

/// Number of wet cells that no chain of links joins to a drain.
std::size_t enclosed_cells(const FlowNetwork& network);

} // namespace listric::fluid
