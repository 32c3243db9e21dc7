#include "coupling/footwall_erosion.hpp"

#include "apps/model/effects/footwall_loads.hpp"

namespace listric {

std::optional<coupling::FootwallLoad> footwall_erosion_load(const Scene& scene) {
    if (!scene.footwall_erosion)
        return std::nullopt;
    coupling::FootwallErosionParameters erosion = *scene.footwall_erosion;
    erosion.rock_density = scene.elastic_base->crust_density;
    return coupling::footwall_erosion_load(erosion, scene.gravity->acceleration,
                                           scene.elastic_base->left, scene.extension.rate);
}

} // namespace listric
