#pragma once

#include "apps/measures/fault.hpp"
#include "apps/scene/scene.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <span>
#include <vector>

namespace listric {

/// The faults that are active in `now`, and how they came to be, from the run's earlier states.
///
/// Traces are ridges of the strain since the state before. A fault is then followed back in time
/// with its footwall: the discs below each of its points say where that point was and how the block
/// turned. It was active in a window if half of the points that existed slid in today's sense; it
/// was born where the activity begins that has lasted two thirds of the time since.
///
/// @param older  earlier states, oldest first
FaultReport report_faults(const Scene& scene, const dem::RigidBase& base, const dem::State& now,
                          std::span<const DiscPlaces> older);

/// Share of the sediment's discs, by area, that are weak and further than `distance` m from every
/// trace. None without sediment.
std::optional<double> weak_off_faults(const dem::State& state, std::span<const Fault> faults,
                                      double distance);

} // namespace listric
