#pragma once

#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/polyline.hpp"
#include "apps/measures/setting.hpp"
#include "dem/state.hpp"

#include <vector>

namespace listric::measures {

/// A line across which rock has come apart in height.
struct OffsetFault {
    Polyline points;            ///< from its upper to its lower end, m
    std::vector<double> offset; ///< of the rock at each point, m, vertical; > 0: normal
    bool is_active = false;     ///< rock came apart in the last window, too
};

/// The lines across which horizons are offset, wherever and whenever rock has slipped.
///
/// What is looked at is how far each disc has come up since it came: along a horizon that is the
/// horizon's shape. Its change with x, less the median of its stratum within eight units, which is
/// the tilt of the block, is a ridge along a fault; those that fall and those that rise to the
/// right are traced by themselves, as the two flanks of a graben of three diameters are. Only discs
/// of one stratum are compared. What falls by less than 30 degrees, as slip along bedding, is left
/// out.
///
/// The offset at a point is the step between discs to its left and its right at the same height,
/// without the tilt of the blocks 3.5 to eight units away: of the three pairs of bands one to five
/// units away the one that differs most. Where less than 65 % of it lies between the innermost ones
/// a horizon bends and is not cut: the offset is 0 there, as it is where one side has too few
/// discs.
///
/// @param before  the last window's start
/// @param least   offset of faults that are looked for, m
std::vector<OffsetFault> offset_faults(const Setting& setting, const dem::State& now,
                                       const DiscPlaces& before, double least);

} // namespace listric::measures
