#pragma once

#include "apps/scene/scene.hpp"

#include <string>

namespace listric {

/// Name of a base, as scenes have it, and what it does to the discs: "ramp (resists, the flat
/// pulls)".
std::string base_name(dem::BaseKind base);

/// The base of a scene in a sentence: what moves with the right wall, and what resists.
std::string base_words(const Scene& scene);

} // namespace listric
