#pragma once

#include "dem/numbers/point.hpp"

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

/// How a drawing lies in the section.
struct DrawingPlace {
    double misfit = 0.0;       ///< largest distance of an svg_points from where it should be, m
    double exaggeration = 1.0; ///< vertical, as drawn
};

/// Points of a fault and where each of them is written.
struct FaultPoints {
    std::vector<dem::Point> points;         ///< m, y up
    std::vector<std::string> where;         ///< "file:line" of each; of a drawing one for all
    bool drawn = false;                     ///< lines between the points are the fault, too
    std::vector<dem::Point> drawing_points; ///< units of the drawing
    DrawingPlace place;                     ///< of a drawing
};

} // namespace listric
