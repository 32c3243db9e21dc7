#include "apps/model/effects/footwall_loads.hpp"

namespace listric {

std::vector<coupling::FootwallLoad> footwall_loads(const Scene& scene) {
    std::vector<coupling::FootwallLoad> loads;
    for (const auto load : {lower_crust_thinning_load, basin_water_load, footwall_erosion_load})
        if (auto made = load(scene))
            loads.push_back(std::move(*made));
    return loads;
}

} // namespace listric
