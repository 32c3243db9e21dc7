#pragma once

#include "dem/point.hpp"

#include <array>
#include <string>
#include <vector>

namespace listric {

/// Where a picked fault is and how it is read: keys of [detachment] that are no part of a scene.
struct FaultSource {
    std::string csv; ///< file with the columns x_m and depth_m
    std::string csv_delimiter = "auto";
    std::string svg;                               ///< drawing
    std::string svg_path;                          ///< id of the path in it
    std::vector<std::array<double, 4>> svg_points; ///< px, py, x (m), depth (m)
    double shift_x = 0.0;                          ///< added to every x, m
    double tolerance = 50.0;                       ///< of the fit, m
};

/// Points of a fault and where each of them is written.
struct FaultPoints {
    std::vector<dem::Point> points; ///< m, y up
    std::vector<std::string> where; ///< "file:line"
};

} // namespace listric
