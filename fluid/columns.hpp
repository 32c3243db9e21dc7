#pragma once

#include "dem/column.hpp"

/// Columns of discs in wet sediment that others read.
namespace listric::fluid::columns {

inline constexpr dem::ColumnName<double> pore_water{"pore_water", "m^2",
                                                    -1.0};           ///< below 0: not yet counted
inline constexpr dem::ColumnName<double> burial{"burial", "m", 0.0}; ///< deepest so far
inline constexpr dem::ColumnName<double> start_grains{
    "start_grains", "m", -1.0}; ///< above porous rock at the first solution; below 0: none yet
inline constexpr dem::ColumnName<double> overpressure_ratio{
    "overpressure_ratio", "1", 0.0}; ///< excess over the weight in water
inline constexpr dem::ColumnName<double> darcy_x{"darcy_x", "m/s", 0.0},
    darcy_y{"darcy_y", "m/s", 0.0};

} // namespace listric::fluid::columns
