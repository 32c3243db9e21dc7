#pragma once

#include "dem/genesis/detachment.hpp"

#include <span>
#include <vector>

namespace listric {

/// Arcs and lines through the points of a picked fault.
struct FaultFit {
    double start_dip = 0.0;                       ///< at the breakaway, (0, 0), degrees
    std::vector<dem::DetachmentSegment> segments; ///< join tangentially; the last is flat
    double misfit = 0.0;                          ///< largest distance of a point from them, m
    std::size_t worst = 0;                        ///< the point that has it
    double end_dip = 0.0; ///< at the last point if nothing is bent there, degrees
    bool flat = false;    ///< the end is flat within the tolerance
};

/// Fits the dip as a piecewise linear function of the distance along the fault, which makes a chain
/// of arcs and lines without kinks, by least squares of the points' distances from it
/// (Levenberg-Marquardt). Pieces are added where the chain is furthest off, until it is within a
/// quarter of the tolerance or more pieces follow noise alone. Dips are 0 to 90 degrees.
/// @param points     from the breakaway down, m, y up; at least three
/// @param tolerance  m
FaultFit fit_fault(std::span<const dem::Point> points, double tolerance);

/// Puts in the largest distance of a point from the segments, and the point.
void measure_misfit(FaultFit& fit, std::span<const dem::Point> points);

/// Distance of a point from a detachment that begins at (0, 0), m.
double distance_from(const dem::Chain& detachment, dem::Point point);

} // namespace listric
