#pragma once

#include <filesystem>

namespace listric {

/// Where the program's own files are: scenes, materials, scripts.
std::filesystem::path source_folder();

} // namespace listric
