#pragma once

#include "apps/scene/effect.hpp"

#include <optional>
#include <string>

namespace listric {

/// Why a run is not begun.
struct Oversize {
    std::string parameter; ///< that causes it: "table.key"
    std::string message;
};

/// Whether a scene with discs would take more cycles, or as much time beside the cycle, than
/// anybody waits for, or more memory than this machine has. Its cause is the parameter that makes
/// the run smallest when it has its default.
/// @param memory  of the machine, bytes
std::optional<Oversize> oversize_of(const Scene& scene, EffectList effects, double memory);

/// Memory of this machine, bytes; infinite where the system does not tell.
double machine_memory();

} // namespace listric
