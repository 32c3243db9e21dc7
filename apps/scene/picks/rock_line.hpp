#pragma once

#include "apps/scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Where the properties of a rock of a scene come from: the material that [materials] or the
/// layer's table names, or the default, and what the scene changes of it.
struct RockOrigin {
    std::string of;                   ///< key in [materials], or "layer NAME"
    std::string name;                 ///< of the material's file
    std::vector<std::string> changed; ///< "table.key" whose values are not the material's
};
using RockOrigins = std::vector<RockOrigin>;

/// Origins of a scene as it was loaded. A run's record names no material: what it was begun with is
/// in its folder (rock_record.hpp).
RockOrigins rock_origins(const Scene& scene);

/// The rocks of a scene with discs and what matters about them: "rock: mat18-b; sediment: mud,
/// friction changed; faults: mat18-w-frictional (friction 0.2); detachment: sheet (pulls), friction
/// 0.5".
std::string rock_line(const Scene& scene);

/// Line of a run whose origins were recorded at its start, or not.
std::string rock_line(const Scene& scene, const std::optional<RockOrigins>& origins);

} // namespace listric
