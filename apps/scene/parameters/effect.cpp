#include "apps/scene/parameters/effect.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace listric {

bool has_effect(const Scene& scene, std::string_view name) {
    return std::ranges::any_of(scene.effects,
                               [&](const EffectPart& part) { return part.effect->name == name; });
}

const BendingBase* bending_base(const Scene& scene) {
    for (const EffectPart& part : scene.effects)
        if (part.effect->bending_base)
            return &part.effect->bending_base(part.parameters);
    return nullptr;
}

namespace {

template <class Is> const Effect& the_one(EffectList effects, Is&& is) {
    const auto found = std::ranges::find_if(effects, is);
    assert(found != effects.end());
    return **found;
}

} // namespace

const Effect& base_bender(EffectList effects) {
    return the_one(effects, [](const Effect* effect) { return effect->bending_base != nullptr; });
}

const Effect& pore_filler(EffectList effects) {
    return the_one(effects, [](const Effect* effect) { return effect->fills_pores; });
}

std::vector<std::string_view> needed_tables(const Effect& effect, EffectList effects) {
    std::vector<std::string_view> needed = effect.needs;
    if (effect.load_footwall)
        needed.push_back(base_bender(effects).name);
    return needed;
}

std::vector<std::string> effect_names(const Scene& scene) {
    std::vector<std::string> names;
    std::ranges::transform(scene.effects, std::back_inserter(names),
                           [](const EffectPart& part) { return std::string(part.effect->name); });
    return names;
}

std::string settling_of(const Scene& scene) {
    std::string words;
    for (const EffectPart& part : scene.effects)
        if (!part.effect->settling.empty())
            words.append(words.empty() ? "" : ", ").append(part.effect->settling);
    return words;
}

std::vector<FigureLayer> figure_layers(const Scene& scene) {
    std::vector<FigureLayer> layers;
    for (const EffectPart& part : scene.effects)
        std::ranges::copy(part.effect->layers, std::back_inserter(layers));
    return layers;
}

std::vector<const MeasuredWell*> measured_wells(const Scene& scene) {
    std::vector<const MeasuredWell*> wells;
    for (const EffectPart& part : scene.effects)
        if (part.effect->well)
            wells.push_back(&*part.effect->well);
    return wells;
}

} // namespace listric
