#include "dem/radius_rates.hpp"

namespace listric::dem {

void add_radius_rates(State& state) {
    state.discs.add<double>("radius_rate", "m/s", 0.0);
    state.discs.add_like<double>("inertial_radius", "m", "radius");
}

} // namespace listric::dem
