#include "coupling/basin_water.hpp"

#include "apps/model/effects/footwall_loads.hpp"

namespace listric {

std::optional<coupling::FootwallLoad> basin_water_load(const Scene& scene) {
    if (!scene.basin_water)
        return std::nullopt;
    return coupling::basin_water_load(*scene.basin_water, scene.gravity->acceleration,
                                      coupling::water_column_width(scene.hanging_wall->mean_radius),
                                      scene.extension.rate);
}

} // namespace listric
