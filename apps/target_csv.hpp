#pragma once

#include "dem/target_line.hpp"

#include <filesystem>
#include <vector>

namespace listric {

/// Reads a target line of sedimentation from a CSV file with a header and the columns time_a, x_m
/// and y_m (others are ignored): rows by time, those of one time by x. Throws SceneError.
std::vector<TargetStage> read_target_csv(const std::filesystem::path& file);

} // namespace listric
