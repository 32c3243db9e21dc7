#pragma once

#include "apps/measures/polyline.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace listric::measures {

/// How far points are from a line.
struct LineMisfit {
    double mean = 0.0, largest = 0.0; ///< m
    dem::Point worst;                 ///< the point that is furthest
    std::size_t compared = 0;         ///< points beside the line
};

/// Distances of points from the nearest of a line's pieces, without those that lie beyond its ends
/// by more than `margin`, m. None if no point is left.
std::optional<LineMisfit> misfit(std::span<const dem::Point> points,
                                 std::span<const Polyline> pieces, double margin);

} // namespace listric::measures
