#include "dem/events/sedimentation.hpp"

#include "dem/cycle.hpp"
#include "dem/ground.hpp"
#include "dem/random.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>

namespace listric::dem {

namespace {

struct Placed {
    Point centre;
    double radius;
};

/// Removes the discs that lie wholly above the line. Returns their mass, kg per metre.
double erode(State& state, const TargetLine& line) {
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    std::vector<std::int32_t> kept;
    double removed = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (line.above({d.x[i], d.y[i]}) > d.radius[i])
            removed += d.mass[i];
        else
            kept.push_back(static_cast<std::int32_t>(i));
    }
    if (kept.empty())
        throw NumericalFailure("erosion: the target line lies below the whole hanging wall; raise "
                               "sedimentation.level_m or the line");
    if (kept.size() < d.x.size())
        reorder_discs(state, kept);
    return removed;
}

/// Fills the ground up to the line until a long row of tries finds no more room.
std::vector<Placed> fill(Ground& ground, const TargetLine& line, double smallest, double largest,
                         std::uint64_t seed, std::uint64_t stratum) {
    std::vector<Placed> placed;
    const double width = ground.right() - ground.left();
    const auto patience = static_cast<std::uint64_t>(20.0 * width / smallest);
    std::uint64_t failures = 0;
    for (std::uint64_t tries = 0; failures < patience; ++tries) {
        const double x =
            ground.left() + width * uniform(seed, Purpose::deposition_place, stratum, tries);
        double radius = smallest + (largest - smallest) *
                                       uniform(seed, Purpose::deposition_radius, stratum, tries);
        ++failures;
        if (ground.height(x, smallest) + smallest > line.height(x) + 2.0 * largest)
            continue;
        auto centre = ground.rest(x, radius);
        // Near the target a smaller disc may still fit.
        if (!centre || line.above(*centre) + radius > 0.0) {
            radius = smallest;
            centre = ground.rest(x, radius);
        }
        if (!centre || line.above(*centre) + radius > 0.5 * smallest)
            continue;
        ground.add(*centre, radius);
        placed.push_back({*centre, radius});
        failures = 0;
    }
    return placed;
}

} // namespace

Sedimentation::Sedimentation(const SedimentationParameters& parameters, double radius_ratio,
                             double extension_rate)
    : Event("sedimentation", {parameters.interval, extension_rate}), parameters_(parameters),
      target_(parameters.level, parameters.target), radius_ratio_(radius_ratio) {}

bool Sedimentation::apply(State& state, const RigidBase& base) {
    const double smallest = 2.0 * state.mean_radius / (1.0 + radius_ratio_);
    const double largest = radius_ratio_ * smallest;
    const auto stratum =
        static_cast<std::int32_t>(std::lround(state.clock.extension / schedule().spacing()));
    const TargetLine line = target_.at(state.clock.extension / schedule().extension_rate);
    const double removed = erode(state, line);
    state.ledger.removed += removed;
    Ground ground(state, base, largest);
    const std::vector<Placed> placed =
        fill(ground, line, smallest, largest, state.seed, static_cast<std::uint64_t>(stratum));
    if (placed.empty())
        return removed > 0.0;

    constexpr double packing_porosity =
        0.166; // of discs under gravity; pores of the rock come on top
    const double density =
        parameters_.grain_density * (1.0 - parameters_.surface_porosity) / (1.0 - packing_porosity);
    const std::size_t first = add_discs(state, placed.size());
    const DiscColumns d = disc_columns(state);
    for (std::size_t k = 0; k < placed.size(); ++k) {
        const std::size_t i = first + k;
        d.x[i] = d.start_x[i] = placed[k].centre.x;
        d.y[i] = d.start_y[i] = placed[k].centre.y;
        d.start_extension[i] = state.clock.extension;
        d.radius[i] = placed[k].radius;
        d.mass[i] = density * pi * placed[k].radius * placed[k].radius;
        d.material[i] = sediment;
        d.stratum[i] = stratum;
        state.ledger.deposited += d.mass[i];
    }
    state.discs.begin_rows(first);
    sort_discs(state);
    return true;
}

} // namespace listric::dem
