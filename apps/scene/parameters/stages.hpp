#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/parameters/stage.hpp"

namespace listric {

const std::vector<Parameter>& stage_parameters();

/// Refuses stages that cannot be, and puts the travel of all of them where the run's end is.
void complete_stages(Scene& scene, const IsGiven& is_given, const Refuse& refuse);

} // namespace listric
