#pragma once

#include "apps/studies/dataset/labelled_section.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace listric {

/// What a file of a section says of it.
struct SectionRecord {
    std::string made_of;     ///< what it is the section of, to tell whether it would be the same
    std::string sha256 = {}; ///< of its arrays, in the order of section_arrays
    std::map<std::string, double> numbers = {};
};

/// Names of the arrays in a file.
inline constexpr const char* section_arrays[] = {"image", "fault",  "fault_throw",
                                                 "layer", "strain", "reflectivity"};

/// Writes a section as HDF5: an array of a row per trace for each name, its numbers as attributes.
/// Throws StorageError.
SectionRecord write_section(const std::filesystem::path& file, const LabelledSection& section,
                            const std::string& made_of);

/// None where there is no such file, or one that cannot be read.
std::optional<SectionRecord> read_section_record(const std::filesystem::path& file);

} // namespace listric
