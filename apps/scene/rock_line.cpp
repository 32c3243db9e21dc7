#include "apps/scene/rock_line.hpp"

#include "apps/scene/file_names.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace listric {

namespace {

namespace fs = std::filesystem;

using Sources = std::vector<RockSource>;

/// Takers of the rock of a key in a scene.
Sources sources_of(const Scene& scene, std::string_view key) {
    Sources sources;
    if (basement_source.key == key)
        sources.push_back(basement_source);
    for (const EffectPart& part : scene.effects)
        if (const auto& rock = part.effect->rock; rock && rock->key == key)
            sources.push_back(*rock);
    return sources;
}

/// Whether a scene's rock is that of the file.
bool is_of(const Scene& scene, const Sources& sources, const fs::path& file) {
    Scene other = scene;
    try {
        const RockMaterial rock = read_material(file);
        for (const RockSource& source : sources) {
            if (source.objection && !source.objection(rock).empty())
                return false;
            source.take(other, rock);
        }
    } catch (const SceneError&) { // it may have changed since, and is none of this scene
        return false;
    }
    return to_toml(other) == to_toml(scene);
}

std::string name_of(const Scene& scene, const Sources& sources) {
    std::vector<fs::path> files;
    if (const auto read = scene.rocks.find(sources.front().key); read != scene.rocks.end())
        files.push_back(read->second);
    for (const std::string& name : materials.names())
        files.push_back(materials.path() / (name + ".toml"));
    const auto found = std::ranges::find_if(
        files, [&](const fs::path& file) { return is_of(scene, sources, file); });
    return found == files.end() ? "its own" : found->stem().string();
}

} // namespace

std::string rock_line(const Scene& scene) {
    std::string line = "rock: " + name_of(scene, sources_of(scene, basement_source.key));
    std::vector<std::string_view> named{basement_source.key}; // some effects share a rock
    for (const EffectPart& part : scene.effects) {
        const auto& rock = part.effect->rock;
        if (!rock || std::ranges::find(named, rock->key) != named.end())
            continue;
        named.push_back(rock->key);
        const std::string name = name_of(scene, sources_of(scene, rock->key));
        if (name != rock->key) // sediment made of sediment says nothing
            line += fmt::format("; {}: {}", rock->plural.empty() ? rock->key : rock->plural, name);
        if (rock->remark)
            line += fmt::format(" ({})", rock->remark(scene));
    }
    if (scene.detachment)
        line += fmt::format("; detachment friction {:g}", scene.detachment->friction);
    if (scene.stretching)
        line += fmt::format("; base friction {:g}", scene.stretching->friction);
    return line;
}

} // namespace listric
