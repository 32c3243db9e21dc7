#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <vector>

namespace listric::effects::base_motion {

/// What a fault of the basement does to the rock above it.
std::vector<Measure<Observation>> measures_of_fault();

} // namespace listric::effects::base_motion
