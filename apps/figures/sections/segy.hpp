#pragma once

#include "apps/figures/sections/seismic_section.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace listric {

/// Writes a section as SEG-Y revision 1 (SEG Technical Standards Committee 2002), samples as IEEE
/// numbers, big endian. A trace's header has its number, CDP, x in centimetres (scalar -100), its
/// samples' interval in microseconds, or millimetres of depth, and where it begins: the delay of
/// recording in ms, or m of depth, from the datum, which is the original surface. Its sample k is
/// at datum - (delay + k interval). Throws StorageError.
/// @param words  lines of the text header, at most 39 of 76 letters each
void write_segy(const std::filesystem::path& file, const SeismicSection& section,
                const std::vector<std::string>& words);

} // namespace listric
