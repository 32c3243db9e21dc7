#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/support/machine/stop.hpp"
#include "apps/support/words/log.hpp"
#include "dem/state.hpp"

#include <filesystem>
#include <functional>
#include <string_view>

namespace listric {

/// Told which stage is how far, as a share.
using StageReport = std::function<void(std::string_view stage, double share)>;

/// Where the hanging wall of a scene is kept: genesis is the same for every scene with the same
/// hanging wall, whatever happens to it afterwards.
std::filesystem::path genesis_cache_path(const Scene& scene, const ModelParts& parts);

/// The hanging wall of a scene before extension: the one that an earlier run has kept, or a new one
/// that is kept for later runs. Throws Interrupted, NumericalFailure.
/// @param report  of a new one, how far it is
dem::State make_or_recall_hanging_wall(const Scene& scene, const ModelParts& parts, Log& log,
                                       const StageReport& report, StopToken stop, int threads);

} // namespace listric
