#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

/// Where a detachment that descends to a flat and then further has its parts, m along the chain.
struct RampFlatRamp {
    double flat_start = 0.0;  ///< the upper ramp soles out
    double flat_end = 0.0;    ///< the kink begins
    double lower_start = 0.0; ///< the kink ends
    double flat_depth = 0.0;  ///< m
};

/// None for a detachment that soles out once.
std::optional<RampFlatRamp> find_ramp_flat_ramp(const dem::Chain& detachment);

/// Rows of the pre-rift discs of a ramp-flat-ramp hanging wall that started below the flat's level,
/// on the lower ramp and within half its height.
std::vector<std::size_t> lower_block(const dem::State& state, const dem::Chain& detachment,
                                     const RampFlatRamp& parts);

/// Rows of the discs that started next to the piece of the detachment that turns them, in the upper
/// half of its depth, and are still on it.
/// @param thickness  depth of a detachment that turns nothing, m
std::vector<std::size_t> head_block(const dem::State& state, const dem::Chain& detachment,
                                    double thickness);

/// Rotation of the head block, degrees, positive toward the detachment. None for fewer than three
/// discs.
std::optional<double> head_block_tilt(const dem::State& state, const dem::Chain& detachment,
                                      double thickness);

/// Rotations of three parts of the hanging wall, degrees, positive toward the detachment. None once
/// a part has left the piece that turns it: the breakaway the upper ramp, the others the lower one.
struct RampFlatRampRotations {
    std::optional<double> breakaway, toe, lower_block;
};
RampFlatRampRotations measure_ramp_flat_ramp(const dem::State& state, const dem::Chain& detachment,
                                             const RampFlatRamp& parts);

/// Whether faults surround the block on the lower ramp of a ramp-flat-ramp, and how many gentle
/// ones are near it. Nothing if hardly any of the block is left.
NamedNumbers measure_lower_block(const RunSoFar& run, const RampFlatRamp& parts,
                                 std::span<const Fault> faults);

std::span<const Quantity> lower_block_quantities();

} // namespace listric::measures
