#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/measures/run_so_far.hpp"
#include "apps/support/measure.hpp"

#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace listric::measures {

/// The faults as a whole, and the two main ones with their history.
/// @param rollover_tilt  of the head block, degrees
NamedNumbers measure_main_faults(const RunSoFar& run, const FaultReport& report,
                                 std::optional<double> rollover_tilt);

/// Unit of a fault's index in a list, a whole number.
inline constexpr std::string_view index_unit = "index";

inline constexpr std::string_view antithetic_foot = "antithetic_foot_x_m";

/// Measures of the report alone.
std::span<const Measure<FaultReport>> fault_report_measures();

/// Quantities that measure_main_faults adds.
std::vector<Quantity> main_fault_quantities();

/// How far nearer to the breakaway a steep normal fault has come up than those born 2 km of
/// extension before it, m: distance from the nearest of them, at the height of its middle. Steep:
/// 45 degrees. 0: none has.
double inner_fault_step(const std::vector<Fault>& faults, dem::Extension tolerance = {});

/// Rank correlation of a fault's throws with the strata's numbers (Spearman), -1 where throw falls
/// from each stratum to the next younger. None for fewer than five strata.
std::optional<double> throw_age_correlation(const std::map<int, double>& throws);

} // namespace listric::measures
