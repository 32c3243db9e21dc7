#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace listric::archive {

/// What a scene's text says of a run: its lines without comments, without empty ones and without
/// whether there is a report, which is nothing of the run.
std::vector<std::string> scene_lines(std::string_view text);

} // namespace listric::archive
