#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <optional>

namespace listric::measures {

/// What a part of the base and the discs on it do to each other now.
struct BasePart {
    /// Shear over normal force, sums over the contacts; above 0 it pulls the discs along its chain,
    /// down the dip and toward the right wall, below 0 it holds them back.
    double mobilised_friction = 0.0;
    /// Speed at which the discs slip along it, mean over its length, over that of the wall; above 0
    /// toward the wall. None while the wall rests.
    std::optional<double> slip_ratio;
    double sliding_share = 0.0; ///< of its length: where contacts have their friction's limit
};

/// Forces between base and discs at a moment.
struct BaseForces {
    std::optional<BasePart> ramp; ///< down to the sole-out point; none: no disc touches it
    std::optional<BasePart> flat; ///< beyond it, or the base that stretches
    std::optional<BasePart> all;
    std::optional<double> right_wall, left_wall; ///< horizontal force of the discs on it, N/m
};

/// @param base  as it was at the start
BaseForces measure_base_forces(const dem::State& state, const dem::RigidBase& base);

} // namespace listric::measures
