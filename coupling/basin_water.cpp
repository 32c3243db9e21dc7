#include "coupling/basin_water.hpp"

#include "coupling/interface_loads.hpp"
#include "dem/base/place.hpp"
#include "dem/columns.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace listric::coupling {

using namespace dem;

namespace {

// Of the loads on the interface.
constexpr const char *in_basin = "basin_water", *in_pores = "pore_water";

std::size_t columns_of(const ConstDiscColumns& d, double width) {
    return static_cast<std::size_t>(std::max(0.0, std::ranges::max(d.x) / width));
}

} // namespace

std::vector<double> water_depths(const State& state, double level, double column_width) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    assert(!d.x.empty() && nodes.x.size() > 1);
    std::vector<double> floor(columns_of(d, column_width));
    for (std::size_t k = 0; k < floor.size(); ++k)
        floor[k] = height_at(nodes, (static_cast<double>(k) + 0.5) * column_width);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (const double column = std::floor(d.x[i] / column_width);
            column >= 0.0 && column < static_cast<double>(floor.size())) {
            double& highest = floor[static_cast<std::size_t>(column)];
            highest = std::max(highest, d.y[i] + d.radius[i]);
        }
    std::ranges::transform(floor, floor.begin(),
                           [&](double y) { return std::max(0.0, level - y); });
    return floor;
}

std::vector<double> pore_water(const State& state, double level, const PoreSpace& pores,
                               double column_width) {
    const ConstDiscColumns d = disc_columns(state);
    const bool compacts = state.discs.has(dem::columns::porosity);
    const auto porosity =
        compacts ? state.discs.get(dem::columns::porosity) : std::span<const double>{};
    std::vector<double> water(columns_of(d, column_width), 0.0);
    if (water.empty())
        return water;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0)
            continue;
        const double phi = compacts ? porosity[i] : pores.porosity;
        const double below = (level - d.y[i] + d.radius[i]) / (2.0 * d.radius[i]);
        const double column = std::clamp(std::floor(d.x[i] / column_width), 0.0,
                                         static_cast<double>(water.size() - 1));
        water[static_cast<std::size_t>(column)] +=
            std::clamp(below, 0.0, 1.0) * d.mass[i] / pores.grain_density * phi / (1.0 - phi);
    }
    return water;
}

double water_weight(const State& state) {
    return weight_on_interface(state, in_basin) + pore_water_weight(state);
}

double pore_water_weight(const State& state) { return weight_on_interface(state, in_pores); }

std::vector<double> flank_depths(const SurfaceResponse& response, std::span<const double> dry,
                                 double level, double weight) {
    // Water adds to its own depth at most its density over the mantle's.
    constexpr double close = 1e-3; // m
    constexpr int most = 200;
    const std::size_t n = response.x.size();
    assert(dry.size() == n);
    std::vector<double> depth(n, 0.0);
    double change = close;
    for (int round = 0; round < most && change >= close; ++round) {
        change = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            double height = dry[k];
            for (std::size_t j = 0; j < n; ++j)
                height += weight * depth[j] * response.uplift[j * n + k];
            const double before = depth[k];
            depth[k] = std::max(0.0, level - height) - std::max(0.0, level);
            change = std::max(change, std::abs(depth[k] - before));
        }
    }
    return depth;
}

BasinWater::BasinWater(const Interface& interface, const BasinWaterParameters& parameters,
                       double gravity, double column_width, const Calendar& calendar,
                       const std::optional<PoreSpace>& pores, std::optional<Flank> flank)
    : Event(in_basin, {parameters.interval, calendar}, dem::Stage::load), parameters_(parameters),
      pores_(pores), flank_(std::move(flank)), gravity_(gravity),
      columns_(interface, column_width) {
    memory.add<double>("start_depth_m", "", 0.0);
    memory.add<double>("flank_depth_m", "m", 0.0);
}

void BasinWater::begin(State& state) {
    if (!parameters_.flank_alone)
        interface_load(state, in_basin, columns_.unknowns());
    if (pores_ && !parameters_.flank_alone)
        interface_load(state, in_pores, columns_.unknowns());
    if (flank_)
        footwall_load(state, name(), columns_.unknowns());
    const std::vector<double> depth = water_depths(state, parameters_.level, columns_.width());
    memory.resize(flank_ ? flank_->response.x.size() : 1);
    std::ranges::fill(memory.get<double>("start_depth_m"),
                      std::accumulate(depth.begin(), depth.end(), 0.0) /
                          static_cast<double>(depth.size()));
}

/// Water in the basin and in the pores of its sediment.
void BasinWater::fill_basin(State& state, const RigidBase& base) const {
    const double start = memory.get<double>("start_depth_m")[0];
    const double weight = parameters_.density * gravity_, width = columns_.width();
    std::vector<double> depth = water_depths(state, parameters_.level, width);
    FilmColumns film;
    if (parameters_.film)
        film = film_columns(*parameters_.film, state, base, parameters_.level, width);
    film.wet.resize(std::max(depth.size(), film.wet.size()), 0.0);
    // Ground that was flooded at the start loses load where it rises.
    for (std::size_t k = 0; k < depth.size(); ++k) {
        depth[k] -= start + film.wet[k];
        depth[k] = weight * (parameters_.level > 0.0 ? depth[k] : std::max(0.0, depth[k]));
    }
    columns_.put(state, in_basin, depth);
    if (pores_) {
        std::vector<double> pressure = pore_water(state, parameters_.level, *pores_, width);
        pressure.resize(std::max(pressure.size(), film.wet.size()), 0.0);
        film.wet.resize(pressure.size(), 0.0);
        for (std::size_t k = 0; k < pressure.size(); ++k)
            pressure[k] = pressure[k] * (weight / width) + weight * film.porosity * film.wet[k];
        columns_.put(state, in_pores, pressure);
    }
}

bool BasinWater::apply(State& state, const RigidBase& base) {
    if (!parameters_.flank_alone)
        fill_basin(state, base);
    if (flank_) {
        const double weight = parameters_.density * gravity_;
        std::ranges::copy(
            flank_depths(flank_->response, flank_->height(state), parameters_.level, weight),
            memory.get<double>("flank_depth_m").begin());
        std::ranges::copy(superpose(flank_pressure(), flank_->forces),
                          footwall_load(state, name(), columns_.unknowns()).begin());
    }
    return false;
}

std::vector<double> BasinWater::flank_pressure() const {
    std::vector<double> pressure;
    for (const double depth : memory.get<double>("flank_depth_m"))
        pressure.push_back(parameters_.density * gravity_ * depth);
    return pressure;
}

fem::Load BasinWater::flank_load() const {
    return surface_load(flank_->response.x, flank_pressure());
}

double BasinWater::flank_weight() const {
    const std::vector<double> pressure = flank_pressure();
    return flank_ ? std::inner_product(pressure.begin(), pressure.end(),
                                       flank_->response.width.begin(), 0.0)
                  : 0.0;
}

namespace {

Flank make_flank(const std::vector<double>& knots, const LoadSolution& solution) {
    const SurfaceResponse surface(knots, solution.interface, solution.sums, solution.work);
    const auto height = [knots, uplift = surface_uplift(surface, solution),
                         others = solution.others](const State& state) {
        std::vector<double> heights = uplift(state);
        for (const OtherLoad& other : others)
            for (std::size_t k = 0; k < heights.size(); ++k)
                heights[k] += other.cover(knots[k]);
        return heights;
    };
    return {surface, solution.forces, height};
}

} // namespace

FootwallLoad basin_water_load(const BasinWaterParameters& parameters, double gravity,
                              double column_width, const Calendar& calendar,
                              const std::optional<PoreSpace>& pores,
                              std::optional<double> flank_left) {
    const std::vector<double> knots =
        flank_left ? surface_knots(-*flank_left, *flank_left) : std::vector<double>{};
    const auto make_event = [=](const LoadSolution& solution) {
        auto event = std::make_unique<BasinWater>(
            solution.base.interface(), parameters, gravity, column_width, calendar, pores,
            flank_left ? std::optional(make_flank(knots, solution)) : std::nullopt);
        BasinWater& water = *event;
        LoadingEvent effect{.event = std::move(event),
                            .measures = [&water, parameters](const State& state) {
                                NamedValues all;
                                if (!parameters.flank_alone)
                                    all = {{basin_water_name, water_weight(state)},
                                           {pore_water_name, pore_water_weight(state)}};
                                all.emplace_back(flank_water_name, water.flank_weight());
                                return all;
                            }};
        if (flank_left) {
            effect.amounts = [&water](const State&) { return water.flank_pressure(); };
            effect.load_elsewhere = [&water](const State&) { return water.flank_load(); };
            effect.take_solution = [&water, knots](const LoadSolution& anew) {
                water.take_flank(make_flank(knots, anew));
            };
        }
        return effect;
    };
    return {surface_loads(knots), make_event};
}

} // namespace listric::coupling
