#pragma once

#include "apps/measures/fault.hpp"
#include "apps/scene/effect.hpp"

#include <filesystem>

namespace listric {

/// Writes the arrays of one moment, which apps/figures/python/frame.py describes, those of its
/// effects, and frame.json into a folder of their own. Throws StorageError.
void write_frame(const Observation& now, const measures::FaultReport& faults,
                 const std::filesystem::path& folder);

} // namespace listric
