#pragma once

namespace listric::dem {

inline constexpr double pi = 3.14159265358979323846;

inline constexpr double standard_gravity = 9.81; ///< m/s^2

/// Share of pores in a packing of discs under gravity: where frictionless packings of genesis end.
inline constexpr double packing_porosity = 0.166;

/// Seconds in a Julian year; geological time is given in years (a).
inline constexpr double seconds_per_year = 365.25 * 86400.0;

} // namespace listric::dem
