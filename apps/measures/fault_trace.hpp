#pragma once

#include "apps/measures/shear_field.hpp"

#include <vector>

namespace listric {

/// A shear zone as a line: the ridge of the shear strain, from its upper to its lower end.
struct FaultTrace {
    std::vector<dem::Point> points; ///< one mean diameter apart, m, y up
    std::vector<double> slip;       ///< of the window at each point, m; > 0: the left side of the
                                    ///< downward direction moves down
    std::vector<double> width;      ///< full width at half maximum of the shear profile, m

    double length() const; ///< m
};

/// What counts as a trace.
struct FaultTraceOptions {
    double least_strain = 0.05;    ///< shear strain per 500 m of extension along a trace
    double certain_strain = 0.15;  ///< and somewhere on it: about AFD's threshold
    double least_length = 12.0;    ///< mean diameters
    double spacing = 3.5;          ///< of parallel traces, mean diameters
    double least_alignment = 0.75; ///< shear along the trace over that of the most strained plane
    /// Strain on the trace over that around it. A zone of Gaussian profile has 3.5 when it is 8
    /// diameters wide; wider ones, and the chance crests of diffuse strain, are no lines.
    double least_contrast = 3.5;
    double profile_reach = 20.0; ///< of the shear profile to either side, mean diameters
};

/// Follows the ridges of the shear strain; the longest trace first. Zones that run along the
/// detachment are left out. Works with and without fault detection, as it looks at strain only.
std::vector<FaultTrace> trace_faults(const ShearField& field, const dem::Chain& detachment,
                                     const FaultTraceOptions& options = {});

/// Dip of the best straight line through the points, degrees in [0, 90].
double dip_of(const std::vector<dem::Point>& points);

/// Curvature of the best parabola over the points' chord, 1/m; > 0: convex upward.
double curvature_of(const std::vector<dem::Point>& points);

/// Distance from the polyline, m, and where the closest point is.
struct PolylinePlace {
    double distance = 0.0; ///< > 0 on the left of the polyline's direction
    double along = 0.0;    ///< m from the first point
    bool beyond = false;   ///< the closest point is an end
};
PolylinePlace place_on(const std::vector<dem::Point>& points, dem::Point p);

} // namespace listric
