#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

struct SceneTable;

/// The tables [[name]] of a scene, in the order of its file.
struct TableItems {
    std::size_t (*count)(const SceneTable& table, const Scene& scene) = nullptr; ///< null: [name]
    const void* (*get)(const SceneTable& table, const Scene& scene, std::size_t item) = nullptr;
    void* (*reach)(const SceneTable& table, Scene& scene, std::size_t item) = nullptr;
    void (*append)(const SceneTable& table, Scene& scene) = nullptr; ///< one with defaults
};

/// A table of the scene file and the part of a scene that it describes; or an array of tables, of
/// which `find` and `add` have the first.
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
    TableItems items = {};

    bool in(const Scene& scene) const { return find(*this, scene) != nullptr; }
    bool is_array() const { return items.count != nullptr; }
    /// How many a scene has.
    std::size_t count(const Scene& scene) const {
        return is_array() ? items.count(*this, scene) : in(scene) ? 1 : 0;
    }
    const void* item(const Scene& scene, std::size_t number) const {
        return is_array() ? items.get(*this, scene, number) : find(*this, scene);
    }
    /// As messages name it: "stage[0]", "gravity".
    std::string path(std::size_t number) const;
    /// As files have it: "[[stage]]", "[gravity]".
    std::string heading() const;
};

/// The parameters above the first table, of a Heading.
const std::vector<Parameter>& top_level();

/// All tables that a scene can have, with those of the effects that there are.
std::vector<SceneTable> scene_tables(EffectList effects);

} // namespace listric
