#pragma once

#include <filesystem>
#include <string>

namespace listric {

/// Draws figures/flexure.png from deflection.csv and summary.json. Returns an empty string, or why
/// it could not.
std::string draw_flexure(const std::filesystem::path& output);

} // namespace listric
