#include "dem/events/compaction.hpp"

#include "dem/base/ground_level.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/grain_columns.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/radius_rates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace listric::dem {

namespace {

/// Share of a column above a place that discs occupy, now and once they have compacted.
struct Cover {
    double now = 0.0, compacted = 0.0;

    double kept() const { return now > 0.0 ? compacted / now : 1.0; }
};

} // namespace

Compaction::Compaction(const CompactionParameters& parameters, double surface_porosity,
                       const Calendar& calendar, Beds beds)
    : Event("compaction", {parameters.interval, calendar}), parameters_(parameters),
      surface_porosity_(surface_porosity), beds_(std::move(beds)) {}

void Compaction::begin(State& state) {
    state.discs.add(columns::porosity, surface_porosity_);
    add_radius_rates(state);
}

bool Compaction::apply(State& state, const RigidBase& base) {
    const DiscColumns d = disc_columns(state);
    const auto porosity = state.discs.get(columns::porosity);
    const auto radius_rate = state.discs.get(columns::radius_rate);
    // A weakened disc has the rock's radius beside its enlarged one; both shrink.
    const bool weakening = state.discs.has(columns::rock_radius);
    const auto rock_radius =
        weakening ? state.discs.get(columns::rock_radius) : std::span<double>{};
    const auto rock_area = weakening ? state.discs.get(columns::rock_area) : std::span<double>{};
    const Travel now = state.clock.travel, next = now + schedule().gap(applied + 2);
    const double seconds = base.motion.time_at(next) - base.motion.time_at(now);
    const GroundLevel ground(state);
    const bool given = state.discs.has(columns::wanted_porosity);
    const auto wanted_porosity =
        given ? state.discs.get(columns::wanted_porosity) : std::span<double>{};
    const PorosityLaw of_all{surface_porosity_, parameters_.coefficient};
    std::ranges::fill(radius_rate, 0.0);
    const auto compact = [&](std::size_t i, Cover& cover) {
        const double area = d.radius[i] * d.radius[i];
        double wanted = porosity[i];
        if (d.stratum[i] > 0) {
            const double depth = cover.kept() * std::max(0.0, ground.depth({d.x[i], d.y[i]}));
            const PorosityLaw& law = beds_.law(d.stratum[i], of_all);
            wanted = given ? wanted_porosity[i]
                           : law.surface_porosity * exponential(-law.coefficient * depth);
        }
        const bool shrinks = wanted < porosity[i];
        const double kept = shrinks ? (1.0 - porosity[i]) / (1.0 - wanted) : 1.0; // grains are kept
        cover.now += area;
        cover.compacted += kept * area;
        if (!shrinks)
            return;
        const double shrinkage = // of the radius
            std::max(std::sqrt(1.0 - approach * (1.0 - kept)), 1.0 - fastest * seconds);
        porosity[i] = 1.0 - (1.0 - porosity[i]) / (shrinkage * shrinkage);
        radius_rate[i] = (shrinkage - 1.0) * d.radius[i] / seconds;
        if (weakening) {
            rock_radius[i] *= shrinkage;
            rock_area[i] *= shrinkage * shrinkage;
        }
    };
    GrainColumns(state).for_each([&](std::span<const std::int32_t> rows) {
        Cover cover;
        for (const std::int32_t row : rows)
            compact(static_cast<std::size_t>(row), cover);
    });
    std::ranges::copy(d.radius, state.discs.get(columns::inertial_radius).begin());
    return false; // lists of smaller discs still hold every contact
}

} // namespace listric::dem
