#pragma once

#include "apps/measures/fault.hpp"
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
    std::optional<double> volume_error_fraction = {}; ///< of weakened discs
    dem::Extension extension = {}, half_a_cycle = {};
    bool has_stages = false; ///< so that the extension may have been greater
    bool base_moves = false; ///< its motion takes part in the balance of areas
};

/// Five lines at most: head block, basin, depocentres, main faults, and whether the run is good by
/// the bounds of docs/trust.md.
std::vector<std::string> result_lines(const Results& results);

} // namespace listric
