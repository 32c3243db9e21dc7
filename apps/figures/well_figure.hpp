#pragma once

#include "apps/archive/folder/run_folder.hpp"
#include "apps/figures/picture_order.hpp"

#include <filesystem>
#include <span>
#include <vector>

namespace listric {

/// Draws well-<extension>km: pressure, porosity and mud weight by depth. False where no effect of
/// the run measures wells, or there is nothing to measure in any of the moments. Throws
/// StorageError, and what run_drawing_script() throws.
/// @param snapshots  of the run
/// @param wells  x, m; none: the effect's own places
bool draw_wells(const archive::RunFolder& run, std::span<const std::filesystem::path> snapshots,
                const std::vector<double>& wells, const std::filesystem::path& pictures,
                const PictureOrder& order);

} // namespace listric
