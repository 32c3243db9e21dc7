#pragma once

#include "apps/scene/scene.hpp"
#include "dem/event.hpp"

#include <memory>
#include <string>
#include <vector>

namespace listric {

/// The events of a scene, in the order in which they are applied at the same moment. An effect
/// whose table is not in the scene has no event, so it has no memory and no cost.
std::vector<std::unique_ptr<dem::Event>> make_events(const Scene& scene);

/// Names of the effects that are on, sorted as in make_events.
std::vector<std::string> effect_names(const Scene& scene);

} // namespace listric
