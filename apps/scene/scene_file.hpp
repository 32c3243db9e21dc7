#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/scene_request.hpp"
#include "apps/support/error.hpp"

#include <string>
#include <utility>
#include <vector>

namespace listric {

/// Reads, merges (default < accuracy level < scene file < set) and checks a scene with the effects
/// that there are. Its name is the file's without folder and ending. Throws SceneError.
Scene load_scene(const SceneRequest& request, EffectList effects);

/// Reads the values of a scene, each by itself, as load_scene does before it compares them. Throws
/// SceneError.
void check_values(const SceneRequest& request, EffectList effects);

/// The name of the scene that a call asks for, which is that of its folder. Throws SceneError.
std::string scene_name(const SceneRequest& request);

/// Refuses a scene that has been loaded because of the value at "table.key", as load_scene does.
/// Throws SceneError.
[[noreturn]] void refuse_scene(const SceneRequest& request, const std::string& path,
                               const std::string& message);

/// All parameters in force as TOML that load_scene reads back to the same scene.
std::string to_toml(const Scene& scene);

/// Reference of every parameter: table, key, type, default, unit, range, symbol, doc.
std::string parameter_reference(EffectList effects);

/// Scenes shipped with the program (or in the folder LISTRIC_SCENES): name and description, sorted
/// by name.
std::vector<std::pair<std::string, std::string>> list_scenes();

} // namespace listric
