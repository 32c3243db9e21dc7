#pragma once

#include "apps/archive/folder/json_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric::archive {

/// A result that tells runs apart at a glance.
struct Headline {
    std::string key;             ///< in summary.json; "number of " a list's key
    std::string name;            ///< its label
    std::string unit;            ///< empty: none
    std::optional<double> value; ///< none: the run does not have it
};

/// The headline results in a run's summary.json, always the same ones in the same order.
std::vector<Headline> headline_of(const JsonObject& summary);

/// A value in units for people: "10 km", "147.6 km²", "38.1°", "0.98", "3".
std::string value_text(const Headline& result);

} // namespace listric::archive
