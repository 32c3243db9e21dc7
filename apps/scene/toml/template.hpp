#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <string>

namespace listric {

/// A scene to be edited, as TOML: what another scene gives, and in comments every other parameter
/// of its tables with its value, unit and meaning, and the tables that it does not have. Its rock
/// is named; files that it reads have absolute paths.
/// @param from  name of a scene or a path
/// Throws SceneError.
std::string scene_template(const std::string& from, EffectList effects);

} // namespace listric
