#include "coupling/base_memory.hpp"

#include <algorithm>
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
constexpr const char* creep = "creep";
constexpr const char* creep_step_name = "creep_step";
constexpr const char* creep_work_name = "creep_work";
constexpr const char* isotherm_name = "isotherm";
constexpr const char* cycles_before = "cycles_before"; // in "creep_step": of the window, before it
constexpr const char* deviator[] = {"stress_xx", "stress_yy", "stress_xy"};

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

void set_isotherm(State& state, const IsothermMemory& memory) {
    Table& rows = state.base_memory[isotherm_name];
    rows.resize(memory.line.size());
    const auto x = rows.add<double>("x", "m", 0.0), y = rows.add<double>("y", "m", 0.0),
               since = rows.add<double>("since", "m", 0.0);
    for (std::size_t k = 0; k < memory.line.size(); ++k) {
        x[k] = memory.line[k].x;
        y[k] = memory.line[k].y;
        since[k] = memory.since;
    }
}

std::optional<IsothermMemory> isotherm(const State& state) {
    const auto found = state.base_memory.find(isotherm_name);
    if (found == state.base_memory.end())
        return std::nullopt;
    const auto x = found->second.get<double>("x"), y = found->second.get<double>("y");
    IsothermMemory memory{{}, found->second.get<double>("since")[0]};
    for (std::size_t k = 0; k < x.size(); ++k)
        memory.line.push_back({x[k], y[k]});
    return memory;
}

void set_creep(State& state, const CreepMemory& memory) {
    Table& points = state.base_memory[creep];
    points.resize(memory.stress.size() / 3);
    for (std::size_t c = 0; c < 3; ++c) {
        const std::span<double> column = points.add<double>(deviator[c], "Pa", 0.0);
        for (std::size_t k = 0; k < column.size(); ++k)
            column[k] = memory.stress[3 * k + c];
    }
    Table& step = state.base_memory[creep_step_name];
    step.resize(1);
    step.add<double>("step", "s", 0.0)[0] = memory.step;
    step.add<double>(cycles_before, "1", 0.0); // stays
    Table& loads = state.base_memory[creep_work_name];
    loads.resize(memory.work.size());
    std::ranges::copy(memory.work, loads.add<double>("work", "J/m", 0.0).begin());
}

std::optional<double> creep_step(const State& state) {
    const auto found = state.base_memory.find(creep_step_name);
    if (found == state.base_memory.end())
        return std::nullopt;
    return found->second.get<double>("step")[0];
}

std::vector<double> creep_stress(const State& state) {
    const auto found = state.base_memory.find(creep);
    if (found == state.base_memory.end())
        return {};
    std::vector<double> stress(3 * found->second.rows());
    for (std::size_t c = 0; c < 3; ++c) {
        const auto column = found->second.get<double>(deviator[c]);
        for (std::size_t k = 0; k < column.size(); ++k)
            stress[3 * k + c] = column[k];
    }
    return stress;
}

std::span<const double> creep_work(const State& state) {
    const auto found = state.base_memory.find(creep_work_name);
    return found == state.base_memory.end() ? std::span<const double>{}
                                            : found->second.get<double>("work");
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
    const auto creeps = state.base_memory.find(creep_step_name);
    const double cycles =
        window_sums(state).cycles -
        (creeps == state.base_memory.end() ? 0.0 : creeps->second.get<double>(cycles_before)[0]);
    if (!(cycles > 0.0)) {
        state.base_memory.erase(last_window);
        return;
    }
    Table& means = state.base_memory[last_window] = table(state, window_means);
    const InterfaceMeans columns = means_of<InterfaceMeans>(means);
    for (const std::span<double> column : {columns.force, columns.displacement, columns.effects})
        for (double& sum : column)
            sum /= cycles;
}

namespace {

void begin_means(State& state, std::size_t unknowns, double cycles_so_far) {
    Table means;
    means.resize(unknowns);
    means.add<double>("force", "N", 0.0);
    means.add<double>("displacement", "m", 0.0);
    state.base_memory[window_means] = std::move(means);
    if (const auto creeps = state.base_memory.find(creep_step_name);
        creeps != state.base_memory.end())
        creeps->second.get<double>(cycles_before)[0] = cycles_so_far;
}

} // namespace

void begin_means_anew(State& state) {
    begin_means(state, table(state, window_means).rows(), window_sums(state).cycles);
}

void begin_window_sums(State& state, std::size_t unknowns) {
    begin_means(state, unknowns, 0.0);
    Table sums;
    sums.resize(1);
    for (const auto& [name, unit] : {std::pair("cycles", "1"), std::pair("reaction_error", "1"),
                                     std::pair("net_load", "N"), std::pair("weight_change", "N")})
        sums.add<double>(name, unit, 0.0);
    state.base_memory[window] = std::move(sums);
}

} // namespace listric::coupling
