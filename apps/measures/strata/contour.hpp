#pragma once

#include "apps/measures/polyline.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace listric::measures {

/// Numbers on the places of a grid, row by row upward.
struct GridValues {
    dem::Point corner;    ///< the first place, m
    double spacing = 0.0; ///< m
    std::size_t columns = 0, rows = 0;
    std::vector<float> values; ///< NaN: not known

    /// Linear between places; NaN where a neighbour is not known or there is none.
    double at(dem::Point p) const;
};

/// Lines along which the values are `level`, linear between places, in an order that depends on the
/// values alone. Larger values are on the right of a line's direction. A closed line ends where it
/// starts.
std::vector<Polyline> contours(const GridValues& grid, double level);

} // namespace listric::measures
