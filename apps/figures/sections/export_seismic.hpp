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

/// Writes a section as SEG-Y revision 1 (SEG Technical Standards Committee 2002), samples as IEEE
/// numbers, big endian. A trace's header has its number, CDP, x in centimetres (scalar -100), its
/// samples' interval in microseconds, or millimetres of depth, and where it begins: the delay of
/// recording in ms, or m of depth, from the datum, which is the original surface. Its sample k is
/// at datum - (delay + k interval). Throws StorageError.
/// @param words  lines of the text header, at most 39 of 76 letters each
void write_segy(const std::filesystem::path& file, const SeismicSection& section,
                const std::vector<std::string>& words);

} // namespace listric
