#pragma once

#include "apps/archive/folder/run_folder.hpp"
#include "apps/figures/picture_order.hpp"

#include <filesystem>

namespace listric {

/// Writes base.csv, the displacement of the detachment at every snapshot of a run whose base moves,
/// and draws it; of an elastic base also footwall.csv, the uplift of its surface and of the
/// detachment at a fifth, half and the whole of the extension, and the stress at the end. Throws
/// StorageError if it cannot.
void draw_base(const archive::RunFolder& run, const std::filesystem::path& tables,
               const std::filesystem::path& pictures, const PictureOrder& order);

/// Draws figures/flexure from deflection.csv and summary.json. Throws what run_drawing_script()
/// throws.
void draw_flexure(const std::filesystem::path& output, const std::filesystem::path& pictures,
                  const PictureOrder& order);

} // namespace listric
