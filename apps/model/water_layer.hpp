#pragma once

#include "apps/support/figure_layer.hpp"
#include "dem/state.hpp"

namespace listric {

/// The water of the basin, "water": rows of x, floor and level (m, y up), from the breakaway on.
FigureLayer water_layer(const dem::State& state, double level, double mean_radius);

} // namespace listric
