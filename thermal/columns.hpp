#pragma once

#include "dem/column.hpp"

/// Columns of discs that have a temperature.
namespace listric::thermal::columns {

inline constexpr dem::ColumnName<double> temperature{"temperature", "degC", 0.0};
inline constexpr dem::ColumnName<double> max_temperature{"max_temperature", "degC", -273.15};
inline constexpr dem::ColumnName<double> heat_capacity{"heat_capacity", "J/K",
                                                       -1.0}; ///< below 0: not yet counted
inline constexpr dem::ColumnName<double> vitrinite{"vitrinite", "%", 0.0}; ///< 0: rock

} // namespace listric::thermal::columns
