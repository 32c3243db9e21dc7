#include "apps/scene/effect.hpp"

#include <algorithm>
#include <iterator>

namespace listric {

bool has_effect(const Scene& scene, std::string_view name) {
    return std::ranges::any_of(scene.effects,
                               [&](const EffectPart& part) { return part.effect->name == name; });
}

std::vector<std::string> effect_names(const Scene& scene) {
    std::vector<std::string> names;
    std::ranges::transform(scene.effects, std::back_inserter(names),
                           [](const EffectPart& part) { return std::string(part.effect->name); });
    return names;
}

std::vector<FigureLayer> figure_layers(const Scene& scene) {
    std::vector<FigureLayer> layers;
    for (const EffectPart& part : scene.effects)
        std::ranges::copy(part.effect->layers, std::back_inserter(layers));
    return layers;
}

} // namespace listric
