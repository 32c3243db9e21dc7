#pragma once

#include "apps/archive/json_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric::archive {

/// A result that tells runs apart at a glance.
struct Headline {
    std::string name, unit;
    std::optional<double> value; ///< none: the run does not have it
};

/// The headline results in a run's summary.json, always the same ones in the same order.
std::vector<Headline> headline_of(const JsonObject& summary);

} // namespace listric::archive
