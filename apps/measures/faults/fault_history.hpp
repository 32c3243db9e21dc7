#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <span>

namespace listric::measures {

/// The faults that are active in `now`, and how they came to be, from the run's earlier states.
///
/// Traces are ridges of the strain since the state before. A fault is then followed back in time
/// with its footwall: the discs below each of its points say where that point was and how the block
/// turned. It was active in a window if half of the points that existed slid in today's sense; it
/// was born where the activity begins that has lasted two thirds of the time since.
///
/// @param older  earlier states, oldest first; without one there are no faults
FaultReport report_faults(const Setting& setting, const dem::RigidBase& base, const dem::State& now,
                          std::span<const DiscPlaces> older);

} // namespace listric::measures
