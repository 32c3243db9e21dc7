#pragma once

#include "apps/archive/exports.hpp"
#include "apps/figures/export_run.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace listric {

/// Writes the seismic image of a moment: folder/seismic-NAME.segy, or as NumPy arrays of a row per
/// trace the image, the faults and the shear strain at its samples (seismic-NAME-image.npy,
/// -faults.npy, -strain.npy) and what their rows and columns are (seismic-NAME.json). Returns the
/// files. Throws StorageError, UsageError.
std::vector<std::filesystem::path> export_seismic(const archive::ExportedMoment& at,
                                                  const std::string& name,
                                                  const std::filesystem::path& folder,
                                                  const ExportRequest& request);

} // namespace listric
