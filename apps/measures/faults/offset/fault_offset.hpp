#pragma once

#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/polyline.hpp"
#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <span>
#include <vector>

namespace listric::measures {

/// A line along which rock has been cut at some time of a run, where it is now.
struct OffsetFault {
    Polyline points;            ///< from its upper to its lower end, m
    std::vector<double> offset; ///< of the rock at each point, m, vertical; > 0: normal
    bool is_active = false;     ///< it has been traced in the last window
};

/// The lines that are traced in the windows of a run, the last one first, each carried to where its
/// footwall is now, and those of the rock's strain since the start; of lines within the spacing of
/// traces of each other the first stands. What falls by less than 30 degrees, as slip along
/// bedding, is left out.
///
/// The offset at a point is how far the two blocks beside it are apart in height at the earliest
/// moment that has discs of both, if each is moved back there with the rigid motion of its discs:
/// all that has been slipped since that rock came, whatever the number of windows.
///
/// @param older  earlier states, oldest first; without one there are none
std::vector<OffsetFault> offset_faults(const Setting& setting, const dem::RigidBase& base,
                                       const dem::State& now, std::span<const DiscPlaces> older);

} // namespace listric::measures
