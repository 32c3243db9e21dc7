#pragma once

#include "apps/measures/moved_points.hpp"

#include <nlohmann/json.hpp>

#include <span>
#include <string>

namespace listric::archive {

/// Where a fault is, m, and how it dips, degrees: the first keys of its object in summary.json.
nlohmann::ordered_json trace_object(const measures::FaultTrace& trace, double dip, bool normal);

/// Faults as objects of JSON, with those keys of summary.json's `faults` that are known without a
/// run, and slip_m and throw_m of the displacement.
std::string to_json(std::span<const measures::TracedFault> faults);

} // namespace listric::archive
