#pragma once

#include "dem/base/target_line.hpp"
#include "dem/calendar.hpp"
#include "dem/column.hpp"
#include "dem/motion.hpp"
#include "dem/state.hpp"

#include <optional>

// Measures of inverted basins. Strata know the travel at which they were deposited; heights
// are above the regional, the line that the basin was filled to when shortening began.

namespace listric::effects::stage {

/// Of discs: shear strain up to the turn.
inline constexpr dem::ColumnName<double> turn_strain{"turn_strain", "1", 0.0};

/// When shortening begins for the first time.
std::optional<dem::Travel> turn_of(const dem::Motion& motion);

/// The regional of a basin that is filled to a target, at the end where nothing shortens.
/// @param rate  of extension, m/a
dem::TargetLine regional_of(const dem::Motion& motion, const dem::Target& target,
                            const dem::Calendar& calendar);

/// Area between the regional and the ground above it, over the footwall, too, m^2. Columns are a
/// mean diameter wide, so that a rough ground at the regional has some.
double area_above_regional(const dem::State& state, const dem::TargetLine& regional);

/// Greatest fall of the pre-rift top (means over 2.5 km) toward the wall, from the crest of the
/// rollover into the graben behind it, m; 0 where it only rises.
double graben_relief(const dem::State& state);

/// How pores of sediment closed with depth.
struct Decompaction {
    double surface_porosity; ///< as deposited
    double decay;            ///< with depth, 1/m
};

/// Null point: extension at which the stratum was deposited whose top, mean from 0.2 to 1.5 km from
/// the breakaway, is at the regional; older ones are below it and younger ones above (Williams,
/// Powell & Cooper 1989, Geol. Soc. Spec. Publ. 44, 3). Linear between strata; 0 where the pre-rift
/// top is at the regional or above, none if all tops are below.
/// @param turn  when shortening began: later strata do not count
/// @param decompaction  adds the thickness that strata below a top have lost since it was laid
///     down, from their porosity now (column `porosity`) and what it was that far below the top
std::optional<double> null_point(const dem::State& state, const dem::Motion& motion,
                                 const dem::TargetLine& regional, dem::Travel turn,
                                 const std::optional<Decompaction>& decompaction = {});

/// Share of the shear strain since the turn (columns `total_strain`, `turn_strain`) of the pre-rift
/// rock that lies in the tenth of its area which extension had strained most. None before any.
std::optional<double> reactivated_share(const dem::State& state);

} // namespace listric::effects::stage
