#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/toml/shelf.hpp"
#include "apps/support/error.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// Where the program's scenes are; the environment's LISTRIC_SCENES names another folder.
inline constexpr Shelf scenes{"scene",
                              "a scene has at least [hanging_wall] and [detachment] or "
                              "[stretching]",
                              "LISTRIC_SCENES", "scenes"};

/// How a call modifies a scene.
struct SceneRequest {
    std::string scene = {};                   ///< name in the scenes folder, or a path
    std::vector<std::string> set = {};        ///< "table.key=value"
    std::vector<std::string> without = {};    ///< tables to drop
    std::optional<std::string> accuracy = {}; ///< draft, standard, fine, sandbox
    std::optional<std::int64_t> seed = {};
    bool is_record = false;        ///< the record in a run's folder, which may have any name
    bool former_rocks = false;     ///< where it names none: those that older versions took
    bool former_intervals = false; ///< where it states none: those of usual_rate, at any rate
};

/// The document in a file, with a call's changes. Throws SceneError.
toml::table merged_document(const SceneRequest& request, const std::filesystem::path& file);

/// Takes out keys that effects had once and whose value is what is done now. Throws SceneError of
/// others.
void take_out_former_keys(toml::table& document, EffectList effects);

/// Reads, merges (default < accuracy level < scene file < set) and checks a scene with the effects
/// that there are. Its name is the file's without folder and ending. Throws SceneError.
Scene load_scene(const SceneRequest& request, EffectList effects);

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
