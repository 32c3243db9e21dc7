#pragma once

#include "apps/fault_trace.hpp"
#include "dem/state.hpp"

#include <map>

namespace listric {

/// Throw of every stratum that the fault cuts, m by stratum number; 0 is the pre-rift top. Positive
/// where the side above the fault lies deeper: normal.
///
/// Height of a stratum's discs between 3 and 12 mean diameters to the left and right of where the
/// trace crosses the stratum, as two parallel lines, one per side; their distance is the throw. The
/// trace is extended upward by up to 15 diameters along its upper end, since young sediment slips
/// too little to be traced.
std::map<int, double> fault_throws(const State& state, const std::vector<Point>& trace);

} // namespace listric
