#pragma once

#include "apps/scene/scene.hpp"

#include <string>

namespace listric {

/// The rocks of a scene with discs and what matters about them: "rock: mat18-b; faults:
/// mat18-w-frictional (friction 0.2); detachment friction 0.5". A name stands where all properties
/// in force are those of its file: of one that the scene has read, or of a shipped one.
std::string rock_line(const Scene& scene);

} // namespace listric
