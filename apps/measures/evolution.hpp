#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/measures.hpp"
#include "apps/measures/paper/kink.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <span>
#include <vector>

namespace listric::measures {

/// Data of this moment that later ones need.
/// @param past  earlier moments, oldest first
Past remember(const Setting& setting, const dem::RigidBase& base, const dem::State& now,
              std::span<const Past> past);

/// Measures of one moment that need the run's past, its faults, or both.
/// @param segments  of faults that detection found so far
/// @param past      earlier moments, oldest first
NamedNumbers measure_evolution(const Setting& setting, const dem::RigidBase& base,
                               const dem::State& now, const FaultReport& faults,
                               const Measures& measures, std::span<const DetectedSegment> segments,
                               std::span<const Past> past);

/// All quantities that can occur, but those in the fault report.
std::vector<Quantity> evolution_quantities();

} // namespace listric::measures
