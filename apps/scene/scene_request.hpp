#pragma once

#include "apps/scene/toml/shelf.hpp"

#include <cstdint>
#include <optional>
#include <string>
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

} // namespace listric
