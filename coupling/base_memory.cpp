#include "coupling/base_memory.hpp"

#include <cassert>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr const char* modes_name = "modes";
constexpr const char* reference = "reference";
constexpr const char* checksum_name = "mesh_checksum"; // in table "reference"
constexpr const char* pushes_name = "pushes";
constexpr const char* window = "window";
constexpr const char* window_means = "window_means";
constexpr const char* last_window = "last_window";

/// The table, writable if the state is.
auto& table(auto& state, const char* name) {
    const auto found = state.base_memory.find(name);
    assert(found != state.base_memory.end() && "the state was attached to an elastic base");
    return found->second;
}

template <class Sums> Sums sums_of(auto& state) {
    auto& sums = table(state, window);
    const auto sum = [&](const char* name) -> auto& { return sums.template get<double>(name)[0]; };
    return {sum("cycles"), sum("reaction_error"), sum("net_load"), sum("weight_change")};
}

template <class Means> Means means_of(auto& means) {
    Means result{
        means.template get<double>("force"), means.template get<double>("displacement"), {}};
    if (means.has("effects"))
        result.effects = means.template get<double>("effects");
    return result;
}

} // namespace

void add_mode_columns(State& state, std::size_t count) {
    Table& motion = state.base_memory[modes_name];
    motion.resize(count);
    motion.add<double>("displacement", "m", 0.0);
    motion.add<double>("velocity", "m/s", 0.0);
}

ModeColumns mode_columns(State& state) {
    Table& motion = table(state, modes_name);
    return {motion.get<double>("displacement"), motion.get<double>("velocity")};
}

std::size_t mode_count(const State& state) {
    const auto motion = state.base_memory.find(modes_name);
    return motion == state.base_memory.end() ? 0 : motion->second.rows();
}

void set_virtual_pressure(State& state, double pressure) {
    Table& row = state.base_memory[reference];
    row.resize(1);
    row.add<double>("virtual_pressure", "Pa", 0.0)[0] = pressure;
}

double virtual_pressure(const State& state) {
    return table(state, reference).get<double>("virtual_pressure")[0];
}

void set_push_sums(State& state, const PushSums& sums) {
    Table& row = state.base_memory[pushes_name];
    row.resize(1);
    row.add<double>("start", "N", 0.0)[0] = sums.start;
    row.add<double>("now", "N", 0.0)[0] = sums.now;
}

PushSums push_sums(const State& state) {
    const auto found = state.base_memory.find(pushes_name);
    if (found == state.base_memory.end())
        return {};
    return {found->second.get<double>("start")[0], found->second.get<double>("now")[0]};
}

void set_mesh_checksum(State& state, std::uint64_t checksum) {
    table(state, reference).add<std::int64_t>(checksum_name, "1", 0)[0] =
        static_cast<std::int64_t>(checksum);
}

std::optional<std::uint64_t> mesh_checksum(const State& state) {
    const Table& row = table(state, reference);
    if (!row.has(checksum_name))
        return std::nullopt;
    return static_cast<std::uint64_t>(row.get<std::int64_t>(checksum_name)[0]);
}

WindowSums window_sums(State& state) { return sums_of<WindowSums>(state); }
ConstWindowSums window_sums(const State& state) { return sums_of<ConstWindowSums>(state); }

InterfaceMeans interface_sums(State& state, bool with_effects) {
    Table& sums = table(state, window_means);
    if (with_effects)
        sums.add<double>("effects", "N", 0.0);
    return means_of<InterfaceMeans>(sums);
}

std::optional<ConstInterfaceMeans> last_window_means(const State& state) {
    const auto means = state.base_memory.find(last_window);
    if (means == state.base_memory.end())
        return std::nullopt;
    return means_of<ConstInterfaceMeans>(means->second);
}

void keep_window_means(State& state) {
    const double cycles = window_sums(state).cycles;
    assert(cycles > 0.0);
    Table& means = state.base_memory[last_window] = table(state, window_means);
    const InterfaceMeans columns = means_of<InterfaceMeans>(means);
    for (const std::span<double> column : {columns.force, columns.displacement, columns.effects})
        for (double& sum : column)
            sum /= cycles;
}

void begin_window_sums(State& state, std::size_t unknowns) {
    Table means;
    means.resize(unknowns);
    means.add<double>("force", "N", 0.0);
    means.add<double>("displacement", "m", 0.0);
    state.base_memory[window_means] = std::move(means);
    Table sums;
    sums.resize(1);
    for (const auto& [name, unit] : {std::pair("cycles", "1"), std::pair("reaction_error", "1"),
                                     std::pair("net_load", "N"), std::pair("weight_change", "N")})
        sums.add<double>(name, unit, 0.0);
    state.base_memory[window] = std::move(sums);
}

} // namespace listric::coupling
