#include "dem/events/compaction.hpp"

#include <algorithm>
#include <cmath>

namespace listric::dem {

Compaction::Compaction(const CompactionParameters& parameters, double surface_porosity,
                       Target surface, double extension_rate)
    : Event("compaction", {parameters.interval, extension_rate}), parameters_(parameters),
      surface_porosity_(surface_porosity), surface_(std::move(surface)) {}

void Compaction::begin(State& state) {
    state.discs.add<double>("porosity", "1", surface_porosity_);
}

bool Compaction::apply(State& state, const RigidBase&) {
    const DiscColumns d = disc_columns(state);
    const auto porosity = state.discs.get<double>("porosity");
    // A weakened disc has the rock's radius beside its enlarged one; both shrink.
    const bool weakening = state.discs.has("rock_radius");
    const auto rock_radius =
        weakening ? state.discs.get<double>("rock_radius") : std::span<double>{};
    const auto rock_area = weakening ? state.discs.get<double>("rock_area") : std::span<double>{};
    const TargetLine surface = surface_.at(state.clock.extension / schedule().extension_rate);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0)
            continue;
        const double depth = std::max(0.0, surface.height(d.x[i]) - d.y[i]);
        const double now = surface_porosity_ * std::exp(-parameters_.coefficient * depth);
        if (now >= porosity[i])
            continue;
        const double shrinkage = (1.0 - porosity[i]) / (1.0 - now); // of volume: grains are kept
        porosity[i] = now;
        d.radius[i] *= std::sqrt(shrinkage);
        if (weakening) {
            rock_radius[i] *= std::sqrt(shrinkage);
            rock_area[i] *= shrinkage;
        }
    }
    return false; // lists of smaller discs still hold every contact
}

} // namespace listric::dem
