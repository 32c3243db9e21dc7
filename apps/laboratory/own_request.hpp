#pragma once

#include "apps/archive/folder/json_file.hpp"

#include <filesystem>
#include <string>

namespace listric {

/// Refuses to replace results of another request than is asked for, and warns where those that are
/// replaced are of another version, damaged, or of a request that is not recorded: "request" in
/// summary.json. Throws UsageError.
void require_same_request(const std::filesystem::path& output, const JsonObject& asked);

/// The version of the program, to be kept in a summary.
std::string summary_version();

/// Refuses to replace results of another material than is asked for. Throws UsageError.
/// @param file  material.toml of the earlier results
void require_same_material(const std::filesystem::path& file, const std::string& asked);

} // namespace listric
