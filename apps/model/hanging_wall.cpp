#include "apps/model/hanging_wall.hpp"

#include "dem/genesis/genesis.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

namespace listric {

using namespace dem;

namespace {

std::vector<RockLayer> layers_of(const ModelParts& parts) {
    std::vector<RockLayer> layers;
    for (const LayerFacts& layer : parts.layers)
        layers.push_back(layer.rock);
    return layers;
}

} // namespace

State make_hanging_wall(const Scene& scene, const ModelParts& parts, const StageReport& report,
                        const StopToken& stop, int threads) {
    // The hanging wall comes to rest on a base that does too, so its mean motion is none.
    RigidBase base = parts.base;
    stand_backstop(base);
    join_blocks(base, 0.0);
    const GenesisRequest request{
        .hanging_wall = scene.hanging_wall,
        .base = std::move(base),
        .materials = parts.materials,
        .bonds = parts.bonds,
        .layers = layers_of(parts),
        .sediment_density =
            parts.sediment ? std::optional(parts.sediment->disc_density) : std::nullopt,
        .physics = {.damping = parts.physics.damping, .gravity = parts.physics.gravity},
        .time_step_safety = scene.cycle.time_step_safety,
        .inertial_mass_floor = scene.cycle.inertial_mass_floor,
        .skin = scene.cycle.skin,
        .seed = scene.seed,
        .execution = {.threads = threads}};
    return dem::make_hanging_wall(request, [&](std::string_view stage, double share) {
        stop.check();
        if (report)
            report(fmt::format("hanging wall: {}", stage), share);
    });
}

} // namespace listric
