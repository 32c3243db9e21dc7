#include "apps/scene/picks/rock_line.hpp"

#include "apps/scene/base_words.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/parameters/flat_base.hpp"
#include "apps/scene/toml/differences.hpp"
#include "apps/scene/toml/file_names.hpp"
#include "apps/scene/toml/toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string_view>

namespace listric {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_named = 4; ///< changed keys; of more the line tells the number

/// Takers of the rock of a key in a scene.
std::vector<RockSource> sources_of(const Scene& scene, std::string_view key) {
    std::vector<RockSource> sources;
    if (basement_source.key == key)
        sources.push_back(basement_source);
    for (const EffectPart& part : scene.effects)
        if (const auto& rock = part.effect->rock; rock && rock->key == key)
            sources.push_back(*rock);
    return sources;
}

/// Keys of [materials] that a scene takes a rock from, each once: some effects share one.
std::vector<std::string_view> rock_keys(const Scene& scene) {
    std::vector<std::string_view> keys{basement_source.key};
    for (const EffectPart& part : scene.effects)
        if (const auto& rock = part.effect->rock;
            rock && std::ranges::find(keys, rock->key) == keys.end())
            keys.push_back(rock->key);
    return keys;
}

/// Parameters that the material's file would change.
std::vector<std::string> changed_of(const Scene& scene, std::string_view key,
                                    const fs::path& file) {
    std::vector<const Effect*> effects;
    for (const EffectPart& part : scene.effects)
        effects.push_back(part.effect);
    Scene other = scene;
    const RockMaterial rock = read_material(file);
    for (const RockSource& source : sources_of(scene, key))
        source.take(other, rock);
    std::vector<std::string> changed;
    for (const SceneDifference& one : scene_differences(scene, other, effects))
        changed.push_back(one.path);
    return changed;
}

/// Parameters of an item that its table gives in place of its material's file.
std::vector<std::string> changed_of(const Scene& scene, std::size_t part, std::size_t item,
                                    const FileParameter& file, const fs::path& path) {
    const Effect& effect = *scene.effects[part].effect;
    Scene blank = scene;
    std::any& parameters = blank.effects[part].parameters = effect.defaults();
    for (std::size_t k = 0; k <= item; ++k)
        effect.items->append(parameters);
    Scene filled = blank;
    file.read_item(filled, item, path.string(), [](const std::string&, const std::string&) {});
    const auto text = [&](const Parameter& parameter, const Scene& of) {
        return value_text(parameter, effect.items->get(of.effects[part].parameters, item));
    };
    std::vector<std::string> changed;
    for (const Parameter& parameter : effect.parameters) {
        const std::string from_file = text(parameter, filled);
        if (from_file != text(parameter, blank) && from_file != text(parameter, scene))
            changed.push_back(fmt::format("{}[{}].{}", effect.name, item, parameter.key));
    }
    return changed;
}

/// Adds those of the items of an effect, each of which may name materials.
void add_items(const Scene& scene, std::size_t part, RockOrigins& origins) {
    const Effect& effect = *scene.effects[part].effect;
    const std::any& parameters = scene.effects[part].parameters;
    const auto named = std::ranges::find(effect.parameters, "name", &Parameter::key);
    for (std::size_t item = 0; item < effect.items->count(parameters); ++item)
        for (const FileParameter& file : effect.files) {
            const auto read =
                scene.rocks.find(fmt::format("{}[{}].{}", effect.name, item, file.key));
            if (read == scene.rocks.end())
                continue;
            std::string name = named == effect.parameters.end()
                                   ? std::to_string(item + 1)
                                   : value_text(*named, effect.items->get(parameters, item));
            std::erase(name, '"');
            origins.push_back(
                {fmt::format("{} {}{}", effect.name, name,
                             file.naming == FileParameter::material_or_none ? ", weakened" : ""),
                 read->second.stem().string(), changed_of(scene, part, item, file, read->second)});
        }
}

/// ", friction changed"
std::string changes(const RockOrigin& origin) {
    if (origin.changed.empty())
        return "";
    if (origin.changed.size() > most_named)
        return fmt::format(", {} keys changed", origin.changed.size());
    std::vector<std::string> keys;
    for (const std::string& path : origin.changed)
        keys.push_back(path.substr(path.rfind('.') + 1));
    return fmt::format(", {} changed", fmt::join(keys, ", "));
}

/// Origin of what a key names, in words.
std::string words_of(const std::optional<RockOrigins>& origins, std::string_view key) {
    if (!origins)
        return "not recorded";
    const auto found = std::ranges::find(*origins, key, &RockOrigin::of);
    return found == origins->end() ? "not recorded" : found->name + changes(*found);
}

} // namespace

RockOrigins rock_origins(const Scene& scene) {
    RockOrigins origins;
    for (const std::string_view key : rock_keys(scene))
        if (const auto read = scene.rocks.find(key); read != scene.rocks.end())
            origins.push_back({std::string(key), read->second.stem().string(),
                               changed_of(scene, key, read->second)});
    for (std::size_t part = 0; part < scene.effects.size(); ++part)
        if (scene.effects[part].effect->items)
            add_items(scene, part, origins);
    return origins;
}

std::string rock_line(const Scene& scene) { return rock_line(scene, rock_origins(scene)); }

std::string rock_line(const Scene& scene, const std::optional<RockOrigins>& origins) {
    std::vector<std::string> parts{"rock: " + words_of(origins, basement_source.key)};
    std::vector<std::string_view> named{basement_source.key};
    for (const EffectPart& part : scene.effects) {
        const auto& rock = part.effect->rock;
        if (!rock || std::ranges::find(named, rock->key) != named.end())
            continue;
        named.push_back(rock->key);
        parts.push_back(fmt::format("{}: {}", rock->plural.empty() ? rock->key : rock->plural,
                                    words_of(origins, rock->key)));
        if (rock->remark)
            parts.back() += fmt::format(" ({})", rock->remark(scene));
    }
    if (origins)
        for (const RockOrigin& origin : *origins)
            if (std::ranges::find(named, origin.of) == named.end())
                parts.push_back(fmt::format("{}: {}{}", origin.of, origin.name, changes(origin)));
    if (scene.detachment)
        parts.push_back(fmt::format("detachment: {}, friction {:g}",
                                    base_name(scene.detachment->base), scene.detachment->friction));
    else if (const auto base = flat_base(scene))
        parts.push_back(fmt::format("base friction {:g}", base->friction));
    return fmt::format("{}", fmt::join(parts, "; "));
}

} // namespace listric
