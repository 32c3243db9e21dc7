#pragma once

#include "apps/measures/faults/fault_trace.hpp"

#include <string>
#include <vector>

namespace listric::measures {

/// Points of a section and how they have moved: particles of any code, or the grid of image
/// velocimetry.
struct MovedPoints {
    std::vector<double> x, y;   ///< before, m, y up
    std::vector<double> dx, dy; ///< displacement, m
};

/// Typical distance of neighbours before they moved, m: median over the points of the mean distance
/// of the four closest. For discs in a packing it is about their diameter. Of at least five points;
/// 0 where most lie on each other.
double spacing_of(const MovedPoints& points);

/// Why no faults can be looked for in them; empty: they can. Beyond a certain size numbers have no
/// decimetres left, and a few points far from all others would make a field of empty room.
std::string objection_to(const MovedPoints& points);

/// Their strain, with that spacing for a diameter; its window is one strain_window.
ShearField shear_field(const MovedPoints& points);

/// A fault that is known only by the motion of the points beside it.
struct TracedFault {
    FaultTrace trace;
    double dip = 0.0;        ///< of the best straight line, degrees
    bool normal = true;      ///< else reverse; a fault of 88 degrees or more always
    double slip = 0.0;       ///< median along the trace, m, without sign
    double throw_down = 0.0; ///< of the side above the fault relative to that below, m; > 0: normal
    double width = 0.0;      ///< median along the trace, in spacings
};

/// The faults, the longest first; none among points that lie on each other or on a line. The least
/// strains of the options are strains of the whole displacement.
std::vector<TracedFault> trace_faults(const MovedPoints& points,
                                      const FaultTraceOptions& options = {});

} // namespace listric::measures
