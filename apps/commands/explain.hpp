#pragma once

#include "apps/scene/scene.hpp"

#include <string>

namespace listric {

/// What would be simulated and what it costs on this machine, as text.
std::string explain(const Scene& scene, int threads);

} // namespace listric
