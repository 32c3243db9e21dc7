#pragma once

#include "apps/scene/effect.hpp"

#include <vector>

namespace listric::effects {

/// Columns, numbers and lists of what the pore fluid does.
std::vector<Measure<Observation>> pore_fluid_measures();
std::vector<MeasuredObjects> pore_fluid_objects();

/// What figures show of it.
std::vector<FigureLayer> pore_fluid_layers();

} // namespace listric::effects
