#include "coupling/lower_crust_thinning.hpp"

#include "apps/model/effects/footwall_loads.hpp"

namespace listric {

std::optional<coupling::FootwallLoad> lower_crust_thinning_load(const Scene& scene) {
    if (!scene.lower_crust_thinning)
        return std::nullopt;
    const ElasticBaseParameters& base = *scene.elastic_base;
    const double contrast =
        (base.mantle_density - base.crust_density) * scene.gravity->acceleration; // Pa/m
    return coupling::lower_crust_thinning_load(*scene.lower_crust_thinning, contrast,
                                               scene.extension.distance, scene.extension.rate);
}

} // namespace listric
