#include "apps/measures/strata/burial.hpp"

#include "apps/measures/strata/owner_map.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double well_fineness = 1.0 / 6.0; ///< of the map, mean diameters, as of horizons

/// Share of a disc of that radius, as wide as high, that lies within [from, to].
double share_within(double x, double radius, double from, double to) {
    return std::clamp((std::min(x + radius, to) - std::max(x - radius, from)) / (2.0 * radius), 0.0,
                      1.0);
}

/// Columns of a map within half a well of x.
struct Window {
    std::size_t first = 0, end = 0;

    Window(const OwnerMap& map, double x, double half) {
        const auto column = [&](double at) {
            return static_cast<std::size_t>(
                std::clamp(std::round((at - map.corner.x) / map.spacing), 0.0,
                           static_cast<double>(map.columns)));
        };
        first = column(x - half);
        end = column(x + half);
    }
};

/// Thickness of strata and of their grains in a window, m, and depth of the ground.
struct WindowColumn {
    std::map<int, double> thickness, grains;
    double ground = 0.0;
};

WindowColumn column_of(const OwnerMap& map, const Window& window, const State& state,
                       std::span<const double> grains_per_place) {
    const ConstDiscColumns d = disc_columns(state);
    WindowColumn column;
    double grounded = 0.0; // columns of the map that have rock
    for (std::size_t c = window.first; c < window.end; ++c) {
        std::optional<std::size_t> top;
        for (std::size_t row = 0; row < map.rows; ++row) {
            const std::int32_t owner = map.owner[row * map.columns + c];
            if (owner < 0)
                continue;
            top = row;
            const auto disc = static_cast<std::size_t>(owner);
            column.thickness[d.stratum[disc]] += map.spacing;
            column.grains[d.stratum[disc]] += grains_per_place[disc] / map.spacing;
        }
        if (!top)
            continue;
        column.ground -= map.place(c, *top).y + 0.5 * map.spacing;
        grounded += 1.0;
    }
    const auto mean = [&](double& sum) { sum = grounded > 0.0 ? sum / grounded : 0.0; };
    mean(column.ground);
    for (auto* sums : {&column.thickness, &column.grains})
        for (auto& [stratum, sum] : *sums)
            mean(sum);
    return column;
}

/// By disc: volume of its grains over its number of places, m^2.
std::vector<double> grains_by_place(const OwnerMap& map, const State& state, double grain_density) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> places(d.x.size());
    for (const std::int32_t owner : map.owner)
        if (owner >= 0)
            places[static_cast<std::size_t>(owner)] += 1.0;
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = places[i] > 0.0 ? d.mass[i] / grain_density / places[i] : 0.0;
    return places;
}

} // namespace

double half_well(const State& state) { return std::min(1000.0, 20.0 * state.mean_radius); }

WellRock rock_of_well(const Setting& setting, const State& state, double grain_density, double x) {
    assert(setting.sediment);
    const ConstDiscColumns d = disc_columns(state);
    const double half = half_well(state);
    struct Sums {
        double discs = 0.0, start_x = 0.0;
    };
    std::map<int, Sums> sums;
    WellRock rock;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] <= 0 || std::abs(d.x[i] - x) > half)
            continue;
        WellStratum& stratum = rock[d.stratum[i]];
        stratum.ids.push_back(d.id[i]);
        stratum.deposited_at = Travel(d.start_travel[i]);
        sums[d.stratum[i]].discs += 1.0;
        sums[d.stratum[i]].start_x += d.start_x[i];
    }
    for (auto& [number, stratum] : rock)
        std::ranges::sort(stratum.ids);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const auto of = sums.find(d.stratum[i]);
        if (of == sums.end())
            continue;
        const double middle = of->second.start_x / of->second.discs;
        const Sediment& sediment = *setting.sediment;
        const double fresh = 1.0 - sediment.pores_of(d.stratum[i]).surface_porosity;
        const double density = sediment.disc_density * (fresh / (1.0 - sediment.surface_porosity));
        const double radius = std::sqrt(d.mass[i] / (pi * density));
        rock[d.stratum[i]].deposited_thickness +=
            share_within(d.start_x[i], radius, middle - half, middle + half) * d.mass[i] /
            grain_density / fresh / (2.0 * half);
    }
    return rock;
}

std::vector<BuriedStratum> buried_strata(const Setting& setting, const RigidBase& base,
                                         const State& state, double grain_density,
                                         const WellRock& rock) {
    const ConstDiscColumns d = disc_columns(state);
    std::map<int, std::pair<double, double>> places; // by stratum: discs and the sum of their x
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (const auto of = rock.find(d.stratum[i]);
            of != rock.end() && std::ranges::binary_search(of->second.ids, d.id[i])) {
            places[d.stratum[i]].first += 1.0;
            places[d.stratum[i]].second += d.x[i];
        }
    if (places.empty())
        return {};
    const OwnerMap map(state, RockSpace(setting, base, state),
                       well_fineness * 2.0 * state.mean_radius);
    const std::vector<double> grains = grains_by_place(map, state, grain_density);
    std::vector<BuriedStratum> strata;
    for (const auto& [stratum, place] : places) {
        const double x = place.second / place.first;
        const WindowColumn column = column_of(map, Window(map, x, half_well(state)), state, grains);
        const auto own = column.thickness.find(stratum);
        if (own == column.thickness.end())
            continue;
        BuriedStratum& buried = strata.emplace_back();
        buried.stratum = stratum;
        buried.x = x;
        buried.ground = buried.top = column.ground;
        for (auto younger = std::next(own); younger != column.thickness.end(); ++younger)
            buried.top += younger->second;
        buried.base = buried.top + own->second;
        buried.porosity = 1.0 - column.grains.at(stratum) / own->second;
    }
    return strata;
}

} // namespace listric::measures
