#pragma once

#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>

namespace listric::measures {

/// Cells of the pre-rift discs, and what presses them. The sum of overlap times length goes with
/// the mean stress. At the start, where all directions are pressed alike, twice this sum over that
/// of squared lengths is the share of the area that compression takes (least squares of the
/// overlaps); later contacts are fewer and carry more, so that the start's lengths go on counting.
RockPacking rock_packing(const dem::State& state, const dem::RigidBase& base);

/// How much the basement has grown by within, wherever its surface is, and how much of that is
/// elastic: measured on its packing, so that the balance of areas can be compared with it.
NamedNumbers measure_dilation(const RunSoFar& run);

inline constexpr std::string_view elastic_area_fraction = "elastic_area_fraction";

std::span<const Quantity> dilation_quantities();

} // namespace listric::measures
