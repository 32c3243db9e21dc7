#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace listric::archive {

/// Content of a scene's text: its lines without comments, empty lines, and whether there is a
/// report, which is nothing of the run.
std::vector<std::string> scene_lines(std::string_view text);

/// A scene's lines by parameter, "table.key"; a table stands there, too, as "[table]".
std::map<std::string, std::string> scene_values(std::string_view text);

/// A parameter in which two scenes differ; nothing: it is not there.
struct LineDifference {
    std::string parameter, one, other;
};

/// Parts of scenes that a comparison covers.
enum class SceneScope {
    all,
    results ///< not at names and descriptions, and of the output at the interval alone
};

/// The first parameter, by name, in which two scenes differ; none if they are the same.
std::optional<LineDifference> scene_difference(const std::map<std::string, std::string>& one,
                                               const std::map<std::string, std::string>& other,
                                               SceneScope scope = SceneScope::all);

} // namespace listric::archive
