#pragma once

#include "apps/scene/scene.hpp"
#include "apps/support/figure_layer.hpp"
#include "dem/state.hpp"

#include <string>
#include <utility>
#include <vector>

namespace listric {

/// What a scene's effects show in its figures.
std::vector<FigureLayer> figure_layers(const Scene& scene, const dem::State& state);

/// Numbers of a scene's effects that the drawing scripts read, by their names in frame.json.
std::vector<std::pair<std::string, double>> figure_numbers(const Scene& scene);

} // namespace listric
