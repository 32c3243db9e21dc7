#pragma once

#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/polyline.hpp"

#include <vector>

namespace listric::measures {

/// Criteria of a ridge of the shear strain.
struct RidgeLimits {
    double least_strain = 0.0;   ///< along it
    double certain_strain = 0.0; ///< and somewhere on it
    double least_length = 0.0;   ///< m
    double spacing = 0.0;        ///< of parallel ridges, m
};

/// Lines along the crests of the field's shear strain, in steps of half a diameter; what goes on
/// beyond a gap is joined.
std::vector<Polyline> find_ridges(const ShearField& field, const RidgeLimits& limits);

} // namespace listric::measures
