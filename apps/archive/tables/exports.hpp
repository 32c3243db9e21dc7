#pragma once

#include "apps/archive/tables/line_table.hpp"
#include "apps/measures/faults/fault.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "dem/columns.hpp"
#include "fluid/columns.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

/// A moment of a run, and the faults that are active then; those that name none may be without.
struct ExportedMoment {
    Observation now;
    measures::FaultReport faults = {};
    std::vector<double> wells = {}; ///< x of wells, m; empty: where the effect has them
};

/// Columns of discs that tables and ParaView show where a run has them.
inline constexpr std::array exported_disc_columns{dem::columns::window_strain,
                                                  dem::columns::total_strain,
                                                  dem::columns::window_tectonic_strain,
                                                  dem::columns::total_tectonic_strain,
                                                  dem::columns::porosity,
                                                  dem::columns::excess_pressure,
                                                  fluid::columns::overpressure_ratio};

// Exports of docs/guides/export.md, a table per kind. Points are rounded to a millimetre.

/// Tops of the strata, cut at faults.
LineTable horizons_table(const ExportedMoment& at);

/// These tops, and the table of them.
std::vector<measures::Horizon> horizons_of(const ExportedMoment& at);
LineTable horizons_table(const ExportedMoment& at, std::span<const measures::Horizon> horizons);

/// Traced faults with the numbers of summary.json.
LineTable faults_table(const ExportedMoment& at);

/// The detachment as it stands, the original surface and the line that sediment is adapted to.
LineTable reference_surfaces_table(const ExportedMoment& at);

/// These and the free surface, which takes longest to find.
LineTable surfaces_table(const ExportedMoment& at);

/// The nodes of a base that deforms; no line if the base is rigid.
LineTable base_table(const ExportedMoment& at);

/// Discs, a "line" for each rock, by id.
LineTable discs_table(const ExportedMoment& at);

/// The place of a well that was asked for, m.
WellPlace well_place(double x);

/// Wells, a "line" each, from the ground down; none where no effect measures wells.
LineTable wells_table(const ExportedMoment& at);

/// Layers of rock, a "line" each along their middles, with their thickness; none without layers.
LineTable layers_table(const ExportedMoment& at);

/// A column of discs: its name and what it holds by row of the disc table.
struct DiscColumn {
    std::string name;
    std::vector<double> values;
};

/// Columns of discs_table besides rock and place.
std::vector<DiscColumn> exported_columns(const ExportedMoment& at);

} // namespace listric::archive
