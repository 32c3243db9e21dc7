#include "apps/model/figure_layers.hpp"

#include "apps/model/water_layer.hpp"

namespace listric {

namespace {

/// Of every disc: 1 where faults have weakened the rock, else 0.
FigureLayer weak_layer(const dem::State& state) {
    FigureLayer layer{"discs_weak", 0, {}};
    for (const std::uint8_t material : dem::disc_columns(state).material)
        layer.rows.push_back(material == dem::weak ? 1.0 : 0.0);
    return layer;
}

} // namespace

std::vector<FigureLayer> figure_layers(const Scene& scene, const dem::State& state) {
    std::vector<FigureLayer> layers;
    if (scene.fault_weakening)
        layers.push_back(weak_layer(state));
    if (scene.basin_water)
        layers.push_back(
            water_layer(state, scene.basin_water->level, scene.hanging_wall->mean_radius));
    return layers;
}

std::vector<std::pair<std::string, double>> figure_numbers(const Scene& scene) {
    if (!scene.sedimentation)
        return {};
    return {{"level_m", scene.sedimentation->level}};
}

} // namespace listric
