#pragma once

#include "apps/scene/effect.hpp"

#include <span>
#include <string>

// JSON schemas (draft 4, the newest that TOML editors know) of the files that users write, from the
// declarations that read them. What a schema cannot say is in docs/editors.md.

namespace listric {

/// Schema of a scene's file, with those effects.
std::string scene_schema(EffectList effects);

/// A table of a plan's file.
struct PlanTable {
    std::string_view name, doc;
    std::vector<Parameter> parameters;
    void* object; ///< that holds their values, or their defaults
};

/// Schema of a plan's file, which begins as a scene does.
std::string plan_schema(const char* title, std::span<const PlanTable> tables);

/// Schema of a material's file.
std::string material_schema();

} // namespace listric
