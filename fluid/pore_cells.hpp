#pragma once

#include "dem/base.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/state.hpp"
#include "fluid/pore_flow.hpp"
#include "fluid/wet_sediment.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::fluid {

// Wet discs, which are those of sediment, as cells of a fluid's flow: power cells, on whose facets
// a difference of two pressures gives flow and force exactly where pressure is linear. Rock is at
// the pressure of water at rest, which is buoyancy, and lets nothing else through: it is dry.

/// Cells of the wet discs.
struct PoreCells {
    std::vector<std::int32_t> rows;      ///< of the discs, by cell
    std::vector<std::int32_t> cell_of;   ///< by row; -1: dry
    dem::FacetedCells faceted;           ///< by cell
    std::vector<double> surface_lengths; ///< by cell: of its edge at the ground, m; 0: covered
    std::vector<double> depths;          ///< by cell: of the centre below the ground, m
    std::vector<double> pending;         ///< by cell: see WetGround, m
    /// By cell: of the centre from where pressure is that of water at rest, m: the depth with what
    /// is pending, at least half a radius, for the ground is smoother than its discs.
    std::vector<double> ground_distances;

    std::size_t count() const { return rows.size(); }
};

/// Cells of sediment. Those at the ground end a radius above the disc's centre.
PoreCells pore_cells(const dem::State& state, const dem::RigidBase& base,
                     const WetSediment& sediment = {});

/// Factors of permeability between two weakened discs, and between a weakened and a sound one.
struct FaultFactors {
    double along = 1.0, across = 1.0;
};

/// Beds of the cells, where water flows along them as it does not across them.
struct Bedding {
    double ratio = 1.0;                   ///< permeability along bedding over that across
    std::vector<dem::Point> normals = {}; ///< by cell, of length 1; empty where the ratio is 1

    /// Permeability in a direction of length 1 over that across: of the flow that way by a gradient
    /// that way.
    double factor(std::size_t cell, dem::Point direction) const;
    /// Gradient by which as much flows across as by the given one along and across.
    dem::Point flow_of(std::size_t cell, dem::Point gradient) const;
};

/// The beds are where sediment is equally old: by the plane through the ages of a cell and its
/// neighbours, mean of the cell's and its neighbours' own. Level where they are too few.
Bedding bedding(const dem::State& state, const PoreCells& cells, double ratio);

/// Links between cells that share a facet, and drains through the ground.
/// @param permeability  by cell across bedding, m^2
/// @param viscosity     of the fluid, Pa s
FlowNetwork flow_network(const dem::State& state, const PoreCells& cells,
                         std::span<const double> permeability, double viscosity,
                         const FaultFactors& faults = {}, const Bedding& beds = {});

/// Number of wet cells that no chain of links joins to a drain.
std::size_t enclosed_cells(const FlowNetwork& network);

/// Gradient of excess pressure in every cell, Pa/m: by Green and Gauss, with 0 at the ground and no
/// flow into rock, base and walls.
std::vector<dem::Point> pressure_gradients(const PoreCells& cells,
                                           std::span<const double> excess_pressure);

/// Forces of excess pressure on all discs, N: on wet ones minus the gradient times the mud's own
/// volume, m^2, since a cell that has opened would be lifted by more than it weighs; on dry ones
/// the pressure on their facets.
std::vector<dem::Point> pore_forces(const dem::State& state, const PoreCells& cells,
                                    std::span<const double> volume,
                                    std::span<const double> excess_pressure);

} // namespace listric::fluid
