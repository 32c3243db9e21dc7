#pragma once

#include <span>
#include <string_view>

namespace listric {

/// Defaults that trade time for detail.
struct AccuracyLevel {
    std::string_view name;
    double mean_radius; ///< of the hanging wall's discs, m
    double cell_size;   ///< of an elastic base at the detachment, m
    double speed;       ///< of extension, m/s: unbalanced forces stay below 4e-3 of contact forces
    double ramp;        ///< model time over which the speed grows from rest, s
    double softness;    ///< of the discs
};

std::span<const AccuracyLevel> accuracy_levels();

/// The level of that name, which must be one.
const AccuracyLevel& accuracy_level(std::string_view name);

} // namespace listric
