#include "coupling/basin_water.hpp"

#include "coupling/interface_loads.hpp"
#include "dem/base_place.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace listric::coupling {

using namespace dem;

std::vector<double> water_depths(const State& state, double level, double column_width) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    assert(!d.x.empty() && nodes.x.size() > 1);
    const double right = std::ranges::max(d.x);
    std::vector<double> floor(static_cast<std::size_t>(std::max(0.0, right / column_width)));
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

double water_weight(const State& state) {
    const std::vector<double> forces = interface_loads(state);
    return -std::accumulate(forces.begin(), forces.end(), 0.0);
}

BasinWater::BasinWater(const Interface& interface, const BasinWaterParameters& parameters,
                       double gravity, double column_width, double extension_rate)
    : Event("basin_water", {parameters.interval, extension_rate}), parameters_(parameters),
      gravity_(gravity), column_width_(column_width), nodes_(interface.x.size()) {
    memory.add<double>("start_depth_m", "", 0.0);
    for (double x = 0.0; x + column_width <= interface.x.back(); x += column_width)
        per_pascal_.push_back(pressure_forces(interface, x, x + column_width));
}

void BasinWater::begin(State& state) {
    interface_load(state, name(), 2 * nodes_);
    const std::vector<double> depth = water_depths(state, parameters_.level, column_width_);
    memory.resize(1);
    memory.get<double>("start_depth_m")[0] =
        std::accumulate(depth.begin(), depth.end(), 0.0) / static_cast<double>(depth.size());
}

bool BasinWater::apply(State& state, const RigidBase&) {
    const double start = memory.get<double>("start_depth_m")[0];
    const std::vector<double> depth = water_depths(state, parameters_.level, column_width_);
    const std::span<double> load = interface_load(state, name(), 2 * nodes_);
    std::ranges::fill(load, 0.0);
    for (std::size_t k = 0; k < std::min(depth.size(), per_pascal_.size()); ++k) {
        const double pressure = parameters_.density * gravity_ * std::max(0.0, depth[k] - start);
        for (std::size_t n = 0; n < nodes_; ++n)
            load[2 * n + 1] -= pressure * per_pascal_[k][n];
    }
    return false;
}

FootwallLoad basin_water_load(const BasinWaterParameters& parameters, double gravity,
                              double column_width, double extension_rate) {
    const auto make_event = [=](const LoadSolution& solution) {
        return LoadingEvent{.event =
                                std::make_unique<BasinWater>(solution.base.interface(), parameters,
                                                             gravity, column_width, extension_rate),
                            .measures = [](const State& state) {
                                return NamedValues{{"basin_water_n_per_m", water_weight(state)}};
                            }};
    };
    return {{}, make_event};
}

} // namespace listric::coupling
