#include "coupling/footwall_loads.hpp"

#include "coupling/elastic_base.hpp"

#include <algorithm>
#include <functional>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr const char* elsewhere = "footwall_loads";
constexpr const char* on_interface = "interface_loads";

/// So many that the load's change with extension, h e / (b + e), is straight between them to 1e-3.
constexpr std::size_t crust_steps = 10;

std::span<double> column_of(State& state, const char* table, std::string_view effect,
                            std::size_t unknowns) {
    Table& loads = state.base_memory[table];
    loads.resize(unknowns);
    return loads.add<double>(effect, "N", 0.0);
}

void add_loads(const State& state, const char* table, std::span<double> forces) {
    const auto loads = state.base_memory.find(table);
    if (loads == state.base_memory.end())
        return;
    for (const Column& column : loads->second.columns()) {
        const auto& values = std::get<std::vector<double>>(column.values);
        for (std::size_t k = 0; k < forces.size(); ++k)
            forces[k] += values[k];
    }
}

} // namespace

std::span<double> footwall_load(State& state, std::string_view effect, std::size_t unknowns) {
    return column_of(state, elsewhere, effect, unknowns);
}

std::span<double> interface_load(State& state, std::string_view effect, std::size_t unknowns) {
    return column_of(state, on_interface, effect, unknowns);
}

std::vector<double> interface_loads(const State& state) {
    const auto loads = state.base_memory.find(on_interface);
    std::vector<double> sum(loads == state.base_memory.end() ? 0 : loads->second.rows(), 0.0);
    add_loads(state, on_interface, sum);
    return sum;
}

bool has_footwall_loads(const State& state) {
    return state.base_memory.contains(elsewhere) || state.base_memory.contains(on_interface);
}

void add_footwall_loads(const State& state, std::span<double> forces) {
    add_loads(state, elsewhere, forces);
    add_loads(state, on_interface, forces);
}

std::vector<double> interface_forces(const ElasticBase& base, const State& state) {
    std::vector<double> forces = base.holding_forces(state), loads(forces.size(), 0.0);
    add_loads(state, elsewhere, loads);
    std::ranges::transform(forces, loads, forces.begin(), std::minus());
    return forces;
}

FootwallResponses solve_footwall_loads(fem::Footwall& footwall, std::size_t unknowns,
                                       const FootwallErosionParameters* erosion, double left,
                                       const LowerCrustThinningParameters* thinning,
                                       double contrast, double distance) {
    FootwallResponses result;
    std::vector<fem::Load> loads;
    if (erosion) {
        result.surface.x = surface_knots(erosion->width, left);
        loads = surface_loads(result.surface.x);
    }
    const std::size_t knots = loads.size();
    if (thinning) {
        result.crust.distance = distance;
        result.crust.steps = crust_steps;
        for (fem::Load& load : lower_crust_loads(*thinning, contrast, distance, crust_steps))
            loads.push_back(std::move(load));
    }
    if (loads.empty())
        return result;

    const fem::Responses solved = footwall.responses(loads);
    const std::size_t all = 2 * footwall.interface().size();
    SurfaceResponse& surface = result.surface;
    for (std::size_t k = 0; k < knots; ++k)
        for (std::size_t i = 0; i < unknowns; ++i)
            surface.interface.push_back(solved.interface[k * all + i]);
    for (std::size_t k = 0; k < knots; ++k)
        surface.width.push_back(-solved.sums[k].y);
    // A pressure's work over its width is the mean of the boundary's sinking there.
    const auto uplift = [&](std::size_t load, std::size_t knot) {
        return -solved.work[load * loads.size() + knot] / surface.width[knot];
    };
    for (std::size_t k = 0; k < knots; ++k)
        for (std::size_t j = 0; j < knots; ++j)
            surface.uplift.push_back(uplift(k, j));
    for (std::size_t row = knots; row < loads.size(); ++row) {
        for (std::size_t i = 0; i < unknowns; ++i)
            result.crust.interface.push_back(solved.interface[row * all + i]);
        for (std::size_t j = 0; j < knots; ++j)
            result.crust.uplift.push_back(uplift(row, j));
    }
    return result;
}

} // namespace listric::coupling
