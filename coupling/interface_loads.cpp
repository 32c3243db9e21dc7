#include "coupling/interface_loads.hpp"

#include <cassert>
#include <numeric>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr const char* elsewhere = "footwall_loads";
constexpr const char* on_interface = "interface_loads";

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
    assert(loads->second.rows() == forces.size());
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

double weight_on_interface(const State& state, std::string_view effect) {
    const auto loads = state.base_memory.find(on_interface);
    if (loads == state.base_memory.end() || !loads->second.has(effect))
        return 0.0;
    const auto forces = loads->second.get<double>(effect); // vertical
    return -std::accumulate(forces.begin(), forces.end(), 0.0);
}

std::vector<double> interface_loads(const State& state) {
    const auto loads = state.base_memory.find(on_interface);
    std::vector<double> sum(loads == state.base_memory.end() ? 0 : loads->second.rows(), 0.0);
    add_loads(state, on_interface, sum);
    return sum;
}

std::vector<double> loads_elsewhere(const State& state, std::size_t unknowns) {
    std::vector<double> sum(unknowns, 0.0);
    add_loads(state, elsewhere, sum);
    return sum;
}

bool has_footwall_loads(const State& state) {
    return state.base_memory.contains(elsewhere) || state.base_memory.contains(on_interface);
}

void add_footwall_loads(const State& state, std::span<double> forces) {
    add_loads(state, elsewhere, forces);
    add_loads(state, on_interface, forces);
}

} // namespace listric::coupling
