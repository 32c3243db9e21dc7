#pragma once

#include <filesystem>

namespace listric {

/// Where the program's own files are (scenes, materials, scripts): the folder LISTRIC_SHARE of the
/// environment, else share/listric beside the folder of the executable, else the source tree that
/// it was built from.
std::filesystem::path resource_folder();

/// Where recorded runs are, by which errors are known: the folder LISTRIC_RECORDS of the
/// environment, else `records` beside scenes, else those of the source tree.
std::filesystem::path record_folder();

/// Whether the executable is an installed one, with its files beside it.
bool is_installed();

} // namespace listric
