#pragma once

#include "apps/scene/effect.hpp"

#include <string_view>
#include <vector>

namespace listric {

/// A table of the scene file and the part of a scene that it describes.
struct SceneTable {
    std::string_view name;
    std::string_view doc;
    std::vector<Parameter> parameters;
    const void* (*find)(const SceneTable& table, const Scene& scene); ///< null: not in the scene
    void* (*add)(const SceneTable& table, Scene& scene); ///< with defaults, if it is not there
    void (*drop)(const SceneTable& table, Scene& scene); ///< null if it cannot be missing
    const Effect* effect = nullptr;                      ///< whose table it is
    /// Besides, what a scene does not keep, but what it stands for: names of files and how they are
    /// read. Of an object of its own, here with defaults.
    std::vector<Parameter> source = {};
    const void* source_defaults = nullptr;

    bool in(const Scene& scene) const { return find(*this, scene) != nullptr; }
};

/// The parameters above the first table, of a Heading.
const std::vector<Parameter>& top_level();

/// All tables that a scene can have, with those of the effects that there are.
std::vector<SceneTable> scene_tables(EffectList effects);

} // namespace listric
