#pragma once

#include "apps/scene/scene.hpp"
#include "dem/base/target_line.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace listric {

/// Reads a line that changes with time from a CSV file with a header and the columns time_a, x_m
/// and `value` (others are ignored): rows by time, those of one time by x. Throws SceneError.
std::vector<dem::TargetStage> read_target_csv(const std::filesystem::path& file,
                                              std::string_view value = "y_m");

/// Reads a line for a scene, in whose model and time it must be; oddities become its warnings.
std::vector<dem::TargetStage> read_target_csv(Scene& scene, const std::filesystem::path& file,
                                              std::string_view value = "y_m");

} // namespace listric
