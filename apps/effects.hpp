#pragma once

#include "apps/scene.hpp"
#include "dem/event.hpp"

#include <memory>
#include <string>
#include <vector>

namespace listric {

/// Extension over which strain is measured, m.
inline constexpr double strain_window = 500.0;

/// The events of a scene, in the order in which they are applied at the same moment. An effect
/// whose table is not in the scene has no event, so it has no memory and no cost.
std::vector<std::unique_ptr<Event>> make_events(const Scene& scene);

/// Materials of a scene, by MaterialIndex.
std::vector<Material> make_materials(const Scene& scene);

/// Detachment, backstop above the breakaway and right wall of a scene.
RigidBase make_base(const Scene& scene);

/// Names of the effects that are on, sorted as in make_events.
std::vector<std::string> effect_names(const Scene& scene);

} // namespace listric
