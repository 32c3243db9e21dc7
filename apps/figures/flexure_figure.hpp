#pragma once

#include "apps/figures/picture_order.hpp"

#include <filesystem>
#include <string>

namespace listric {

/// Draws figures/flexure from deflection.csv and summary.json. Returns an empty string, or why
/// it could not.
std::string draw_flexure(const std::filesystem::path& output, const PictureOrder& order);

} // namespace listric
