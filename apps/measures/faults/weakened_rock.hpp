#pragma once

#include "apps/measures/faults/fault.hpp"
#include "dem/state.hpp"

#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

// Weakened discs are not all faults: detection also weakens stretches of its circle where sediment
// gives way without a line. What is of a fault is so by one definition, for pictures and measures.

/// Distance from a trace within which what is weakened is of it, mean diameters.
inline constexpr double of_fault = 5.0;

/// Whether each disc is weakened and of a fault: within of_fault of a traced line, or of a band of
/// touching weakened discs that is as long as the shortest line that would be traced, for a fault
/// that rests has no trace.
std::vector<bool> weakened_by_faults(const dem::State& state, std::span<const Fault> faults);

/// Share of the weakened discs, by area, that is of no fault. None where nothing is weakened.
std::optional<double> weak_off_fault(const dem::State& state, std::span<const Fault> faults);

} // namespace listric::measures
