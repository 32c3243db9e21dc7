#include "dem/events/property_update.hpp"

#include "dem/base/rest.hpp"
#include "dem/contacts/soft_discs.hpp"

namespace listric::dem {

namespace {

constexpr double spacing_of_soft_layers = 25.0; // m of travel

} // namespace

PropertyUpdate::PropertyUpdate(const FaultWeakeningParameters& parameters, const Calendar& calendar,
                               double gravity)
    : Event("property_update", {parameters.update_interval, calendar}), parameters_(parameters),
      gravity_(gravity) {}

PropertyUpdate::PropertyUpdate(const Calendar& calendar, double gravity)
    : Event("property_update", Schedule::every(spacing_of_soft_layers, calendar)),
      gravity_(gravity) {}

bool PropertyUpdate::apply(State& state, const RigidBase& base) {
    const VolumeKeeping how{parameters_.band_diameters * state.mean_radius,
                            mean_stress_ratio(parameters_, state, base), parameters_.largest_change,
                            !rests_from_now(base, state.clock)};
    return keep_volume(state, base, how, gravity_).has_value();
}

} // namespace listric::dem
