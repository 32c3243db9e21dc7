#pragma once

#include "apps/scene/effect.hpp"

#include <string>

namespace listric {

/// What would be simulated and what it costs on this machine, as text.
/// @param effects  all that there are
std::string explain(const Scene& scene, int threads, EffectList effects);

} // namespace listric
