#pragma once

#include "apps/measures/paper/kink.hpp"
#include "apps/measures/setting.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "dem/event.hpp"

#include <memory>
#include <span>
#include <vector>

namespace listric::archive {

/// Facts of a scene that measures need; it must have a hanging wall.
measures::Setting make_setting(const Scene& scene, const ModelParts& parts);

/// The fault segments that detection has found so far; none if the scene has no fault detection.
std::vector<measures::DetectedSegment>
fault_segments(std::span<const std::unique_ptr<dem::Event>> events);

} // namespace listric::archive
