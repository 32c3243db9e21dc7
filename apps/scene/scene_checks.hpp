#pragma once

#include "apps/scene/effect.hpp"
#include "apps/scene/toml.hpp"

#include <string>

namespace listric {

/// The value at a path of keys, or else its table, or else the document.
Entry entry_at(const toml::table& document, const std::string& path);

/// Checks of tables against each other, which no single parameter can fail. Throws SceneError.
void check_scene(const Scene& scene, const toml::table& document, EffectList effects);

} // namespace listric
