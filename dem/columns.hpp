#pragma once

#include "dem/column.hpp"
#include "dem/material.hpp"

#include <cstdint>

/// Columns that more than one file reads: each name stands here alone. What one effect remembers
/// for itself it names itself. A room above that gives dem a column fills one of these.
namespace listric::dem::columns {

// Discs; of nodes of a base that bends `x`, `y`, `vx` and `vy`, too.
inline constexpr ColumnName<std::int64_t> id{"id", "1", -1};
inline constexpr ColumnName<double> x{"x", "m", 0.0};
inline constexpr ColumnName<double> y{"y", "m", 0.0};
inline constexpr ColumnName<double> vx{"vx", "m/s", 0.0};
inline constexpr ColumnName<double> vy{"vy", "m/s", 0.0};
inline constexpr ColumnName<double> rotation{"rotation", "rad", 0.0};
inline constexpr ColumnName<double> spin{"spin", "rad/s", 0.0};
inline constexpr ColumnName<double> radius{"radius", "m", 0.0};
inline constexpr ColumnName<double> mass{"mass", "kg", 0.0};
inline constexpr ColumnName<std::uint8_t> material{"material", "1", basement};
inline constexpr ColumnName<std::int32_t> stratum{"stratum", "1",
                                                  0}; ///< 0: rock; n: of the n-th layer of sediment
inline constexpr ColumnName<double> start_x{"start_x", "m",
                                            0.0}; ///< where it was at the start, or was laid down
inline constexpr ColumnName<double> start_y{"start_y", "m", 0.0};
inline constexpr ColumnName<double> start_travel{"start_travel", "m",
                                                 0.0}; ///< travel at which it was laid down
inline constexpr ColumnName<double> searched_x{"searched_x", "m",
                                               0.0}; ///< at the last search for neighbours
inline constexpr ColumnName<double> searched_y{"searched_y", "m", 0.0};
inline constexpr ColumnName<std::uint8_t> layer{"layer", "1",
                                                0}; ///< index of its rock layer, from 1; 0: none
inline constexpr ColumnName<float> mean_vx{
    "mean_vx", "m/s", 0.0f}; ///< mean velocity of the surroundings, for relative damping
inline constexpr ColumnName<float> mean_vy{"mean_vy", "m/s", 0.0f};
inline constexpr ColumnName<double> push_x{"push_x", "N",
                                           0.0}; ///< force beside the weight (dem/pushes.hpp)
inline constexpr ColumnName<double> push_y{"push_y", "N", 0.0};
inline constexpr ColumnName<double> radius_rate{
    "radius_rate", "m/s", 0.0}; ///< change with every cycle (dem/radius_rates.hpp)
inline constexpr ColumnName<double> inertial_radius{"inertial_radius", "m",
                                                    0.0}; ///< of the moment of inertia
inline constexpr ColumnName<double> rock_radius{
    "rock_radius", "m", 0.0}; ///< as sound rock, before weakening (dem/contacts/soft_discs.hpp)
inline constexpr ColumnName<double> rock_area{"rock_area", "m^2",
                                              0.0}; ///< of the power cell, as sound rock
inline constexpr ColumnName<double> window_strain{
    "window_strain", "1", 0.0}; ///< shear strain of the window of extension (dem/events/strain.hpp)
inline constexpr ColumnName<double> total_strain{"total_strain", "1", 0.0}; ///< of all windows
inline constexpr ColumnName<double> window_tectonic_strain{
    "window_tectonic_strain", "1", 0.0}; ///< the same less what compaction makes; a note
inline constexpr ColumnName<double> total_tectonic_strain{"total_tectonic_strain", "1", 0.0};
inline constexpr ColumnName<double> porosity{"porosity", "1",
                                             0.0}; ///< of sediment (dem/events/compaction.hpp)
inline constexpr ColumnName<double> excess_pressure{
    "excess_pressure", "Pa",
    0.0}; ///< of pore water over the hydrostat, for whoever moves water to give
inline constexpr ColumnName<double> wanted_porosity{
    "wanted_porosity", "1",
    0.0}; ///< porosity to which pore water lets the sediment compact, given likewise
inline constexpr ColumnName<double> lift{"lift", "N", 0.0}; ///< by excess pressure, part of push_y

// Contacts of two discs.
inline constexpr ColumnName<std::int32_t> first{"first", "1", -1};
inline constexpr ColumnName<std::int32_t> second{"second", "1", -1};
inline constexpr ColumnName<double> shear_force{"shear_force", "N", 0.0};
inline constexpr ColumnName<double> rolling_moment{
    "rolling_moment", "N m", 0.0}; ///< on the second disc, or of the base (dem/rolling.hpp)
inline constexpr ColumnName<std::uint8_t> bonded{"bonded", "1", 0};
inline constexpr ColumnName<float> tensile_strength{"tensile_strength", "N", 0.0f};
inline constexpr ColumnName<float> shear_strength{"shear_strength", "N", 0.0f};

// Contacts of a disc and the base; `shear_force` as above.
inline constexpr ColumnName<std::int32_t> disc{"disc", "1", -1};
inline constexpr ColumnName<std::int32_t> surface{"surface", "1", -1}; ///< segment of the base
inline constexpr ColumnName<double> place{
    "place", "1", -1.0}; ///< along the segment of a base that bends, 0 to 1; -1: not yet known

// Nodes of a base that bends.
inline constexpr ColumnName<double> ux{"ux", "m", 0.0}, uy{"uy", "m", 0.0};
inline constexpr ColumnName<double> searched_ux{"searched_ux", "m", 0.0},
    searched_uy{"searched_uy", "m", 0.0};
inline constexpr ColumnName<double> excess_x{"excess_x", "N", 0.0}, ///< forces of excess pressure
    excess_y{"excess_y", "N", 0.0};
inline constexpr ColumnName<double> excess_size{"excess_size", "N",
                                                0.0}; ///< magnitude of that pressure, times length
inline constexpr ColumnName<std::int64_t> load_x{"load_x", "2^-10 N", 0},
    load_y{"load_y", "2^-10 N", 0};

} // namespace listric::dem::columns
