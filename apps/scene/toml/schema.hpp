#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <string>

// JSON schemas (draft 4, the newest that TOML editors know) of the files that users write, from the
// declarations that read them. What a schema cannot say is in docs/guides/editors.md.

namespace listric {

/// Schema of a scene's file, with those effects.
std::string scene_schema(EffectList effects);

/// Schema of a material's file.
std::string material_schema();

} // namespace listric
