#include "fluid/pore_column.hpp"

#include "fluid/pore_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric::fluid {

namespace {

/// Layers from the floor up.
struct Layers {
    std::vector<double> grains, water, excess_pressure, burial;
    std::vector<MudColumn::Bed> kinds;

    std::size_t count() const { return grains.size(); }
};

double porosity(const Layers& layers, std::size_t k) {
    return porosity_at(layers.kinds[k].law, layers.burial[k]);
}

double thickness(const Layers& layers, std::size_t k) {
    return layers.grains[k] / (1.0 - porosity(layers, k));
}

/// What is laid down at a time, s.
MudColumn::Bed kind_at(const MudColumn& column, double time) {
    constexpr double almost = 1.0 - 1e-9;
    for (const MudColumn::Bed& bed : column.beds)
        if (almost * time <= bed.until)
            return bed;
    return column.beds.empty() ? MudColumn::Bed{0.0, column.law, column.mud} : column.beds.back();
}

std::vector<double> grains_above(const Layers& layers) {
    std::vector<double> above(layers.count());
    double sum = 0.0;
    for (std::size_t k = layers.count(); k-- > 0;) {
        above[k] = sum + 0.5 * layers.grains[k];
        sum += layers.grains[k];
    }
    return above;
}

FlowNetwork network_of(const MudColumn& column, const Layers& layers) {
    FlowNetwork network;
    network.drains.assign(layers.count(), 0.0);
    double height_below = 0.0, k_below = 0.0;
    for (std::size_t k = 0; k < layers.count(); ++k) {
        const double height = thickness(layers, k);
        const double k_here = permeability(layers.kinds[k].mud, porosity(layers, k));
        if (k > 0)
            network.links.push_back({static_cast<std::int32_t>(k - 1), static_cast<std::int32_t>(k),
                                     2.0 * k_below * k_here / (k_below + k_here) /
                                         (column.viscosity * 0.5 * (height_below + height))});
        if (k + 1 == layers.count())
            network.drains[k] = k_here / (column.viscosity * 0.5 * height);
        height_below = height;
        k_below = k_here;
    }
    return network;
}

/// Fills the column up.
void deposit(const MudColumn::Bed& kind, double floor, Layers& layers, SunkColumn& sunk) {
    double height = 0.0;
    for (std::size_t k = 0; k < layers.count(); ++k)
        height += thickness(layers, k);
    const double room = floor - height, pores = kind.law.surface_porosity, solid = 1.0 - pores;
    if (room <= 0.0)
        return;
    layers.grains.push_back(solid * room);
    layers.water.push_back(pores * room);
    layers.excess_pressure.push_back(0.0);
    layers.burial.push_back(0.0);
    layers.kinds.push_back(kind);
    sunk.grains += solid * room;
    sunk.came += pores * room;
}

void drain(const MudColumn& column, double step, Layers& layers, SunkColumn& sunk) {
    const std::vector<double> above = grains_above(layers);
    PressureBounds bounds;
    for (const double grains : above)
        bounds.highest.push_back(column.fracture_ratio * column.law.grain_weight * grains);
    bounds.lowest.assign(layers.count(), -std::numeric_limits<double>::infinity());
    const Storage storage = [&](std::size_t k, double u) {
        const PoreLaw& law = layers.kinds[k].law;
        const VoidRatio e = void_ratio(law, above[k], layers.burial[k], u);
        const double swelling = 1.0 + law.compressibility * u;
        return Stored{layers.grains[k] * e.value * swelling,
                      layers.grains[k] * (e.slope * swelling + e.value * law.compressibility)};
    };
    const FlowOutcome outcome = flow(network_of(column, layers), storage, bounds, step,
                                     layers.water, layers.excess_pressure);
    for (std::size_t k = 0; k < layers.count(); ++k)
        layers.burial[k] = std::max(layers.burial[k], burial_under(layers.kinds[k].law, above[k],
                                                                   layers.excess_pressure[k]));
    sunk.surface += outcome.surface;
    sunk.vented += outcome.vented;
    sunk.most_steps = std::max(sunk.most_steps, outcome.steps);
    sunk.converged = sunk.converged && !outcome.stuck;
}

} // namespace

SteadyColumn sink_steadily(const MudColumn& column, double distance, double seconds) {
    constexpr std::size_t steps = 100;
    const auto in_steps = [&](std::size_t n) {
        return sink(column, steady_floor(distance, n), seconds / static_cast<double>(n));
    };
    return {in_steps(steps), in_steps(2 * steps), column.fracture_ratio};
}

MudLayer SteadyColumn::at(double depth) const {
    const MudLayer a = coarse.at(depth), b = fine.at(depth);
    const auto limit = [](double from, double to) { return 2.0 * to - from; };
    return {depth, limit(a.grains_above, b.grains_above),
            limit(a.excess_pressure, b.excess_pressure), limit(a.porosity, b.porosity),
            std::min(limit(a.overpressure_ratio, b.overpressure_ratio), fracture_ratio)};
}

MudLayer SunkColumn::at(double depth) const {
    // Layers go up, so depths descend.
    const auto after =
        std::ranges::find_if(layers, [&](const MudLayer& l) { return l.depth < depth; });
    if (after == layers.begin())
        return layers.empty() ? MudLayer{} : layers.front();
    if (after == layers.end())
        return layers.back();
    const MudLayer &a = *(after - 1), &b = *after;
    const double share = (a.depth - depth) / (a.depth - b.depth);
    const auto between = [&](double from, double to) { return from + share * (to - from); };
    return {depth, between(a.grains_above, b.grains_above),
            between(a.excess_pressure, b.excess_pressure), between(a.porosity, b.porosity),
            between(a.overpressure_ratio, b.overpressure_ratio)};
}

SunkColumn sink(const MudColumn& column, std::span<const double> floor, double step) {
    Layers layers;
    SunkColumn sunk;
    double time = 0.0;
    for (const double depth : floor) {
        time += step;
        deposit(kind_at(column, time), depth, layers, sunk);
        drain(column, step, layers, sunk);
    }
    const std::vector<double> above = grains_above(layers);
    double top = 0.0;
    for (std::size_t k = 0; k < layers.count(); ++k)
        top += thickness(layers, k);
    double bottom = 0.0;
    for (std::size_t k = 0; k < layers.count(); ++k) {
        const double height = thickness(layers, k);
        const double u = layers.excess_pressure[k];
        sunk.layers.push_back({top - bottom - 0.5 * height, above[k], u, porosity(layers, k),
                               u / (column.law.grain_weight * above[k])});
        bottom += height;
        sunk.left += layers.water[k];
    }
    return sunk;
}

std::vector<double> steady_floor(double distance, std::size_t steps) {
    std::vector<double> floor;
    for (std::size_t k = 1; k <= steps; ++k)
        floor.push_back(distance * static_cast<double>(k) / static_cast<double>(steps));
    return floor;
}

double gibson_number(const MudColumn& column, double rate, double time) {
    constexpr double porosity = 0.2;
    const double solid = 1.0 - porosity;
    // Change of volume by stress, 1/Pa: de/dsigma / (1 + e).
    const double softness = column.law.decay * porosity / (column.law.grain_weight * solid * solid);
    const double consolidation =
        permeability(column.mud, porosity) / (column.viscosity * softness); // m^2/s
    return rate * rate * time / consolidation;
}

} // namespace listric::fluid
