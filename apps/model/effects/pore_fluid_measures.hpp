#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <vector>

namespace listric::effects {

/// Measures of the pore fluid.
std::vector<Measure<Observation>> pore_fluid_measures();
std::vector<MeasuredObjects> pore_fluid_objects();

/// Layers of figures.
std::vector<FigureLayer> pore_fluid_layers();

} // namespace listric::effects
