#include "dem/base/water_level.hpp"

#include <algorithm>

namespace listric::dem {

double WaterLevel::at(const State& state) const {
    return heights.at(calendar.age(state.clock.travel)).height(0.0);
}

std::vector<double> dry_weights(const State& state, double level, double buoyancy) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> weights;
    weights.reserve(d.x.size());
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double above = (d.y[i] + d.radius[i] - level) / (2.0 * d.radius[i]);
        weights.push_back(buoyancy * d.mass[i] * std::clamp(above, 0.0, 1.0));
    }
    return weights;
}

} // namespace listric::dem
