#include "apps/model/water_layer.hpp"

#include "coupling/basin_water.hpp"

namespace listric {

FigureLayer water_layer(const dem::State& state, double level, double mean_radius) {
    const double width = coupling::water_column_width(mean_radius);
    FigureLayer layer{"water", 3, {0.0, level, level}}; // the shore at the breakaway
    double x = 0.5 * width;
    for (const double depth : coupling::water_depths(state, level, width)) {
        layer.rows.insert(layer.rows.end(), {x, level - depth, level});
        x += width;
    }
    return layer;
}

} // namespace listric
