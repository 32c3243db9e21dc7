#pragma once

#include "dem/state.hpp"

#include <string>
#include <utility>
#include <vector>

namespace listric {

/// The footwall's measures over a run for summary.json, from its history and its end.
std::vector<std::pair<std::string, double>> footwall_summary(const dem::Table& history,
                                                             const dem::State& state);

} // namespace listric
