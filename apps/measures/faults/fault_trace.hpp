#pragma once

#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/polyline.hpp"
#include "dem/events/strain.hpp"

#include <vector>

namespace listric::measures {

/// A shear zone as a line: the ridge of the shear strain, from its upper to its lower end.
struct FaultTrace {
    Polyline points;           ///< one mean diameter apart, m, y up
    std::vector<double> slip;  ///< of the window at each point, m; > 0: the left side of the
                               ///< downward direction moves down
    std::vector<double> width; ///< full width at half maximum of the shear profile, m

    double length() const { return length_of(points); } ///< m
};

/// Criteria of a trace.
struct FaultTraceOptions {
    double least_strain = 0.05;    ///< shear strain per strain_window of extension along a trace
    double certain_strain = 0.15;  ///< and somewhere on it: about AFD's threshold
    double least_length = 12.0;    ///< mean diameters
    double spacing = 3.5;          ///< of parallel traces, mean diameters
    double least_alignment = 0.75; ///< shear along the trace over that of the most strained plane
    /// Strain on the trace over that around it. A zone of Gaussian profile has 3.5 when it is 8
    /// diameters wide; wider ones, and the chance crests of diffuse strain, are no lines.
    double least_contrast = 3.5;
    double profile_reach = 20.0; ///< of the shear profile to either side, mean diameters

    /// least_strain of a window of that much extension.
    double least_strain_in(dem::Extension window) const {
        return least_strain * window.m / dem::strain_window;
    }
};

/// Follows the ridges of the shear strain; the longest trace first. Zones that run along the
/// detachment are left out. Works with and without fault detection, as it looks at strain only.
std::vector<FaultTrace> trace_faults(const ShearField& field, const dem::Chain& detachment,
                                     const FaultTraceOptions& options = {});

} // namespace listric::measures
