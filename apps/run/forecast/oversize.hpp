#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace listric {

/// Why a run is not begun.
struct Oversize {
    std::string parameter; ///< that causes it: "table.key"
    std::string message;
    bool is_of_disk = false; ///< the disk is too small, not the scene too large
};

/// Room for a run, bytes; infinite where it is unknown.
struct FreeSpace {
    double memory, disk;
    bool is_job = false; ///< whether the memory is what this job may use of the machine's
};

/// Memory of this machine or job, and the disk that is free where a folder is or will be.
FreeSpace room_for(const std::filesystem::path& output);

/// Whether a scene with discs would take more cycles, or as much time beside the cycle, than
/// anybody waits for, more memory or disk than there is, or end with five times as many discs as it
/// starts with. Its cause is the parameter that makes the run smallest when it has its default.
std::optional<Oversize> oversize_of(const Scene& scene, EffectList effects, const FreeSpace& room);

} // namespace listric
