#pragma once

#include "apps/scene/scene.hpp"
#include "coupling/footwall_loads.hpp"

#include <optional>
#include <vector>

namespace listric {

// What effects put on the elastic footwall of a scene that has one; none where an effect is off.

std::optional<coupling::FootwallLoad> lower_crust_thinning_load(const Scene& scene);
std::optional<coupling::FootwallLoad> basin_water_load(const Scene& scene);
std::optional<coupling::FootwallLoad> footwall_erosion_load(const Scene& scene);

/// All of them, in the order in which they are applied at the same moment.
std::vector<coupling::FootwallLoad> footwall_loads(const Scene& scene);

} // namespace listric
