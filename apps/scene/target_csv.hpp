#pragma once

#include "dem/target_line.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace listric {

/// Reads a line that changes with time from a CSV file with a header and the columns time_a, x_m
/// and `value` (others are ignored): rows by time, those of one time by x. Throws SceneError.
std::vector<dem::TargetStage> read_target_csv(const std::filesystem::path& file,
                                              std::string_view value = "y_m");

/// Whether a CSV file's header has a column. Throws SceneError if it cannot be read.
bool csv_has_column(const std::filesystem::path& file, std::string_view name);

} // namespace listric
