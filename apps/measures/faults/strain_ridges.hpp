#pragma once

#include "apps/measures/polyline.hpp"

#include <span>
#include <vector>

namespace listric::measures {

/// A strain, 0 or more, at the places of discs.
struct StrainedPlaces {
    std::span<const double> x, y; ///< m
    std::span<const double> strain = {};
    double diameter = 0.0;     ///< m
    double discs_across = 1.0; ///< mean diameters in that
};

/// Criteria of a ridge of strain.
struct RidgeLimits {
    double least_strain = 0.0;   ///< along it
    double certain_strain = 0.0; ///< and somewhere on it
    double least_length = 0.0;   ///< m
    double spacing = 0.0;        ///< of parallel ridges, m
};

/// Lines along the crests of the strain, in steps of half a diameter; what goes on beyond a gap is
/// joined.
std::vector<Polyline> find_ridges(const StrainedPlaces& places, const RidgeLimits& limits);

} // namespace listric::measures
