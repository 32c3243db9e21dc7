#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <vector>

namespace listric::effects::heat {

/// What is measured and drawn of temperatures.
std::vector<Measure<Observation>> heat_measures();
std::vector<MeasuredObjects> heat_objects();
std::vector<FigureLayer> heat_layers();
MeasuredWell heat_well();

} // namespace listric::effects::heat
