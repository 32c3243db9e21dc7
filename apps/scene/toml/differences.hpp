#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <string>
#include <vector>

namespace listric {

/// A parameter that two scenes have with different values, or a table that only one has.
struct SceneDifference {
    std::string path; ///< "table.key", or "table"
    std::string unit;
    std::string first, second; ///< values as TOML; "on", "off" of a table
};

/// Differences of two scenes, defaults filled in, in the order of scene files. Names and
/// descriptions do not count.
std::vector<SceneDifference> scene_differences(const Scene& first, const Scene& second,
                                               EffectList effects);

} // namespace listric
