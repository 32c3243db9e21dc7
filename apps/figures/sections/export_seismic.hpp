#pragma once

#include "apps/archive/tables/exports.hpp"
#include "apps/figures/sections/seismic_section.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace listric {

/// Writes the seismic image of a moment: folder/seismic-NAME.segy, or as NumPy arrays of a row per
/// trace the image, the faults and the shear strain at its samples (seismic-NAME-image.npy,
/// -faults.npy, -strain.npy) and what their rows and columns are (seismic-NAME.json); behind NAME
/// stand options that are not the usual ones: seismic-NAME-depth-40Hz-lateral-500m. Returns the
/// files. Throws StorageError, UsageError.
/// @param formats  "segy", "npy" or both
std::vector<std::filesystem::path> export_seismic(const archive::ExportedMoment& at,
                                                  const std::string& name,
                                                  const std::filesystem::path& folder,
                                                  const std::vector<std::string>& formats,
                                                  SeismicOptions options);

} // namespace listric
