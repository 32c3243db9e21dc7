#include "dem/events/compaction.hpp"

#include "dem/ground_level.hpp"
#include "dem/radius_rates.hpp"

#include <algorithm>
#include <cmath>

namespace listric::dem {

Compaction::Compaction(const CompactionParameters& parameters, double surface_porosity,
                       double extension_rate)
    : Event("compaction", {parameters.interval, extension_rate}), parameters_(parameters),
      surface_porosity_(surface_porosity) {}

void Compaction::begin(State& state) {
    state.discs.add<double>("porosity", "1", surface_porosity_);
    add_radius_rates(state);
}

bool Compaction::apply(State& state, const RigidBase& base) {
    const DiscColumns d = disc_columns(state);
    const auto porosity = state.discs.get<double>("porosity");
    const auto radius_rate = state.discs.get<double>("radius_rate");
    // A weakened disc has the rock's radius beside its enlarged one; both shrink.
    const bool weakening = state.discs.has("rock_radius");
    const auto rock_radius =
        weakening ? state.discs.get<double>("rock_radius") : std::span<double>{};
    const auto rock_area = weakening ? state.discs.get<double>("rock_area") : std::span<double>{};
    const bool averages = state.discs.has("mean_vy");
    const auto mean_vy = averages ? state.discs.get<float>("mean_vy") : std::span<float>{};
    const Motion& motion = base.motion;
    const double extension = state.clock.extension;
    const double seconds =
        motion.time_at(extension + schedule().spacing()) - motion.time_at(extension);
    const GroundLevel ground(state);
    std::ranges::fill(radius_rate, 0.0);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0)
            continue;
        const double sinks = averages ? -seconds * mean_vy[i] : 0.0;
        const double depth = std::max(0.0, ground.depth({d.x[i], d.y[i]}) + sinks);
        const double wanted = surface_porosity_ * std::exp(-parameters_.coefficient * depth);
        if (wanted >= porosity[i])
            continue;
        // Of the radius; grains are kept.
        const double shrinkage =
            std::max(std::sqrt((1.0 - porosity[i]) / (1.0 - wanted)), 1.0 - fastest * seconds);
        porosity[i] = 1.0 - (1.0 - porosity[i]) / (shrinkage * shrinkage);
        radius_rate[i] = (shrinkage - 1.0) * d.radius[i] / seconds;
        if (weakening) {
            rock_radius[i] *= shrinkage;
            rock_area[i] *= shrinkage * shrinkage;
        }
    }
    std::ranges::copy(d.radius, state.discs.get<double>("inertial_radius").begin());
    return false; // lists of smaller discs still hold every contact
}

} // namespace listric::dem
