#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>

namespace listric::measures {

/// The plane on which a disc's surroundings shear, if they shear on one: of the two planes of
/// largest shear, the one whose simple shear turns the way the displacement field does.
struct ShearPlane {
    double strain = 0.0;     ///< engineering shear strain, > 0
    double dip = 0.0;        ///< degrees
    bool falls_right = true; ///< away from the breakaway
    bool reverse = false;
};
ShearPlane shear_plane(const ShearField& field, std::size_t k);

/// A piece of a fault that detection found.
struct DetectedSegment {
    dem::Point centre; ///< m
    double dip = 0.0;  ///< degrees; below 90 it falls to the breakaway
    double slip = 0.0; ///< of the interval, m; > 0: reverse
    dem::Travel found_at;
};

/// Whether the rock above the kink of a ramp-flat-ramp shears on reverse faults.
/// @param segments  all that were found so far
NamedNumbers measure_kink(const RunSoFar& run, const RampFlatRamp& parts,
                          std::span<const Fault> faults, std::span<const DetectedSegment> segments);

std::span<const Quantity> kink_quantities();

} // namespace listric::measures
