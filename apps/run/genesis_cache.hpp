#pragma once

#include "apps/model/hanging_wall.hpp"
#include "apps/support/words/log.hpp"

#include <filesystem>

namespace listric {

/// Where the hanging wall of a scene is kept: genesis is the same for every scene with the same
/// hanging wall, whatever happens to it afterwards.
std::filesystem::path genesis_cache_path(const Scene& scene, const ModelParts& parts);

/// The hanging wall of a scene before extension: the one that an earlier run has kept, or a new one
/// that is kept for later runs. Throws Interrupted, NumericalFailure.
/// @param report  of a new one, how far it is
dem::State make_or_recall_hanging_wall(const Scene& scene, const ModelParts& parts, Log& log,
                                       const StageReport& report, StopToken stop, int threads);

} // namespace listric
