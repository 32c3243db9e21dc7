#pragma once

#include <filesystem>

namespace listric {

/// Where the program's own files are (scenes, materials, scripts): the folder LISTRIC_SHARE of the
/// environment, else share/listric beside the folder of the executable, else the source tree that
/// it was built from.
std::filesystem::path resource_folder();

/// Whether the executable is an installed one, with its files beside it.
bool is_installed();

} // namespace listric
