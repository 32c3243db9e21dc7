#pragma once

#include "apps/figures/picture_order.hpp"

#include <filesystem>

namespace listric {

/// Draws figures/flexure from deflection.csv and summary.json. Throws what run_drawing_script()
/// throws.
void draw_flexure(const std::filesystem::path& output, const std::filesystem::path& pictures,
                  const PictureOrder& order);

} // namespace listric
