#pragma once

#include "apps/run/prediction.hpp"
#include "apps/scene/effect.hpp"

#include <string>

namespace listric {

/// What would be simulated and what it costs on this machine, as text.
/// @param speed    with that many threads
/// @param effects  all that there are
std::string explain(const Scene& scene, const CycleSpeed& speed, int threads, EffectList effects);

/// The same at the speed that is measured now.
std::string explain(const Scene& scene, int threads, EffectList effects);

} // namespace listric
