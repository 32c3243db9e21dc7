#pragma once

#include "apps/scene/scene.hpp"

#include <filesystem>
#include <string>

namespace listric {

// Hints to the user of a run that ends early.

/// The call that resumes the run of a folder.
std::string resume_hint(const std::filesystem::path& output);

/// Which snapshot of a folder is the newest.
std::string last_good_state(const std::filesystem::path& output);

/// The call of a run that may not fail as this one did. A run repeats itself to the last bit, so it
/// would fail again: it needs another step, or speed.
std::string retry_hint(const Scene& scene, const std::filesystem::path& output);

} // namespace listric
