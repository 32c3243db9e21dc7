#pragma once

#include "apps/scene/effect.hpp"
#include "apps/support/log.hpp"
#include "apps/support/stop.hpp"
#include "dem/state.hpp"

#include <filesystem>

namespace listric {

/// Where the hanging wall of a scene is kept: genesis is the same for every scene with the same
/// hanging wall, whatever happens to it afterwards.
std::filesystem::path genesis_cache_path(const Scene& scene, const ModelParts& parts);

/// The hanging wall of a scene before extension: the one that an earlier run has kept, or a new one
/// that is kept for later runs. Throws Interrupted, NumericalFailure.
dem::State make_or_recall_hanging_wall(const Scene& scene, const ModelParts& parts, Log& log,
                                       StopToken stop, int threads);

} // namespace listric
