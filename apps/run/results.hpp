#pragma once

#include "apps/archive/quality.hpp"
#include "apps/measures/faults/fault.hpp"
#include "apps/measures/measures.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Results of a run, for people. A value without a meaning in the run is absent.
struct Results {
    const measures::Measures& measures;
    const measures::FaultReport& faults;
    std::optional<double> basin_depth = {}; ///< deepest pre-rift top, smoothed over 1 km, m
    std::vector<archive::QualityCheck> quality = {};
};

/// A line each: head block, basin, depocentres, main faults, and whether the run is good by the
/// bounds of docs/explain/trust.md; where it is not a line for each reason.
std::vector<std::string> result_lines(const Results& results);

} // namespace listric
