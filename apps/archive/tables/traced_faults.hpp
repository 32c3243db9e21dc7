#pragma once

#include "apps/measures/faults/moved_points.hpp"

#include <span>
#include <string>

namespace listric::archive {

/// Faults as objects of JSON, with those keys of summary.json's `faults` that are known without a
/// run, and slip_m and throw_m of the displacement.
std::string to_json(std::span<const measures::TracedFault> faults);

} // namespace listric::archive
