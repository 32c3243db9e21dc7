#include "dem/events/compaction.hpp"

#include "dem/base/ground_level.hpp"
#include "dem/radius_rates.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace listric::dem {

namespace {

/// Rows of all discs by columns two mean diameters wide, each from the top down.
struct Columns {
    std::vector<std::int32_t> column, order; ///< by row; of rows
    std::vector<std::size_t> ends;           ///< of columns that have discs, in the order

    explicit Columns(const State& state) {
        const ConstDiscColumns d = disc_columns(state);
        const double left = std::ranges::min(d.x), width = 4.0 * state.mean_radius;
        for (const double x : d.x)
            column.push_back(static_cast<std::int32_t>((x - left) / width));
        order.resize(column.size());
        std::iota(order.begin(), order.end(), 0);
        const auto key = [&](std::int32_t row) {
            const auto i = static_cast<std::size_t>(row);
            return std::tuple(column[i], -d.y[i], row);
        };
        sort_shared(std::span(order),
                    [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
        const auto column_at = [&](std::size_t k) {
            return column[static_cast<std::size_t>(order[k])];
        };
        for (std::size_t k = 1; k <= order.size(); ++k)
            if (k == order.size() || column_at(k) != column_at(k - 1))
                ends.push_back(k);
    }
};

/// Share of a column above a place that discs occupy, now and once they have compacted.
struct Cover {
    double now = 0.0, compacted = 0.0;

    double kept() const { return now > 0.0 ? compacted / now : 1.0; }
};

} // namespace

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
    const double extension = state.clock.extension;
    const double seconds =
        base.motion.time_at(extension + schedule().spacing()) - base.motion.time_at(extension);
    const GroundLevel ground(state);
    const Columns columns(state);
    std::ranges::fill(radius_rate, 0.0);
    const auto compact = [&](std::size_t i, Cover& cover) {
        const double depth = cover.kept() * std::max(0.0, ground.depth({d.x[i], d.y[i]}));
        const double wanted = surface_porosity_ * std::exp(-parameters_.coefficient * depth);
        const double area = d.radius[i] * d.radius[i];
        const bool shrinks = d.stratum[i] > 0 && wanted < porosity[i];
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
    in_pieces(columns.ends.size(), 8, [&](std::size_t column, std::size_t end) {
        for (; column < end; ++column) {
            Cover cover;
            for (std::size_t k = column == 0 ? 0 : columns.ends[column - 1];
                 k < columns.ends[column]; ++k)
                compact(static_cast<std::size_t>(columns.order[k]), cover);
        }
    });
    std::ranges::copy(d.radius, state.discs.get<double>("inertial_radius").begin());
    return false; // lists of smaller discs still hold every contact
}

} // namespace listric::dem
