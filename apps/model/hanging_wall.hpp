#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/support/machine/stop.hpp"
#include "dem/state.hpp"

#include <functional>
#include <string_view>

namespace listric {

/// Told which stage is how far, as a share.
using StageReport = std::function<void(std::string_view stage, double share)>;

/// The hanging wall of a scene before extension, made anew. Throws Interrupted, NumericalFailure.
dem::State make_hanging_wall(const Scene& scene, const ModelParts& parts, const StageReport& report,
                             const StopToken& stop, int threads);

} // namespace listric
