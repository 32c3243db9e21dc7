#pragma once

#include <filesystem>

namespace listric {

/// Writes base.csv, the displacement of the detachment at every snapshot of a run on an elastic
/// base, and draws it. Throws StorageError if it cannot.
void draw_base(const std::filesystem::path& output);

} // namespace listric
