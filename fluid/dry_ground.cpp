#include "fluid/dry_ground.hpp"

#include "dem/columns.hpp"
#include "dem/pushes.hpp"

namespace listric::fluid {

using namespace dem;

DryGround::DryGround(const WaterLevel& level, double buoyancy, const Schedule& schedule,
                     bool on_top)
    : Event("dry_ground", schedule, Stage::load), level_(level), buoyancy_(buoyancy),
      on_top_(on_top) {}

void DryGround::begin(State& state) { add_pushes(state); }

bool DryGround::start(State& state, const RigidBase&) {
    const std::vector<double> weights = dry_weights(state, level_.at(state), buoyancy_);
    const auto push_y = state.discs.get(dem::columns::push_y);
    for (std::size_t i = 0; i < weights.size(); ++i)
        push_y[i] = -weights[i];
    return false;
}

bool DryGround::apply(State& state, const RigidBase& base) {
    if (!on_top_)
        return start(state, base);
    const std::vector<double> weights = dry_weights(state, level_.at(state), buoyancy_);
    const auto push_y = state.discs.get(dem::columns::push_y);
    for (std::size_t i = 0; i < weights.size(); ++i)
        push_y[i] -= weights[i];
    return false;
}

} // namespace listric::fluid
