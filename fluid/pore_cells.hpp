#pragma once

#include "dem/base.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/state.hpp"
#include "fluid/wet_sediment.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::fluid {

// Wet discs, which are those of sediment and of porous rock, as cells of a fluid's flow: power
// cells, on whose facets a difference of two pressures gives flow and force exactly where pressure
// is linear. Other rock is at the pressure of water at rest, which is buoyancy, and lets nothing
// else through: it is dry.

/// Cells of the wet discs.
struct PoreCells {
    std::vector<std::int32_t> rows;      ///< of the discs, by cell
    std::vector<std::int32_t> cell_of;   ///< by row; -1: dry
    std::vector<const PorousRock*> rock; ///< by cell; null: sediment
    std::vector<dem::Point> centres;     ///< by cell, m
    /// By cell: permeability, m^2. Empty: pressure changes evenly from one to the next.
    std::vector<double> permeability;
    dem::FacetedCells faceted;           ///< by cell
    std::vector<double> surface_lengths; ///< by cell: of its edge at the ground, m; 0: covered
    std::vector<double> depths;          ///< by cell: of the centre below the ground, m
    std::vector<double> pending;         ///< by cell: see WetGround, m
    /// By cell: of the centre from where pressure is that of water at rest, m: the depth with what
    /// is pending, at least half a radius, for the ground is smoother than its discs.
    std::vector<double> ground_distances;

    std::size_t count() const { return rows.size(); }
};

/// Cells of sediment and porous rock. Those at the ground end a radius above the disc's centre.
PoreCells pore_cells(const dem::State& state, const dem::RigidBase& base,
                     const WetSediment& sediment = {});

/// The facet of one cell that another has as its own; null where the ground ends that one short of
/// it.
const dem::PowerFacet* facet_between(const PoreCells& cells, std::size_t first, std::size_t second);

/// From a cell's centre to the middle of its facet with another, or where rock is involved to where
/// pressure has changed by as much as in the cell itself: it changes in what conducts less, m.
dem::Point pressure_arm(const PoreCells& cells, std::size_t cell, const dem::PowerFacet& facet,
                        std::size_t other);

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
