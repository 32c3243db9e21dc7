#include "apps/model/footwall_summary.hpp"

#include <cmath>

namespace listric {

using namespace dem;

namespace {

/// The largest size of a value; windows without one do not count.
double largest(std::span<const double> values) {
    double most = 0.0;
    for (const double value : values)
        if (std::abs(value) > most)
            most = std::abs(value);
    return most;
}

} // namespace

NamedNumbers footwall_summary(const Table& history, const State& state) {
    if (!history.has("footwall_uplift_m"))
        return {};
    const auto column = [&](const char* name) { return history.get<double>(name); };
    double sum = 0.0, windows = 0.0;
    for (const double error : column("base_reaction_error"))
        if (!std::isnan(error)) {
            sum += error;
            ++windows;
        }
    // Where the base is now: the run may have been ended within a window.
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    NamedNumbers measures = {
        {"footwall_uplift_m", nodes.uy[0]},
        {"breakaway_shift_m", nodes.ux[0]},
        {"base_deflection_max_m", largest(nodes.uy)},
    };
    for (const char* name :
         {"interface_force_error", "interface_moment_error", "interface_work_error"})
        measures.emplace_back(name, largest(column(name)));
    measures.emplace_back("base_reaction_error", windows > 0.0 ? sum / windows : 0.0);
    for (const auto& last : last_values(history, {"net_wall_load_n_per_m", "net_wall_load_error"}))
        measures.push_back(last);
    for (const char* name : {"strong_rock_strain_max", "relaxed_rock_strain_max",
                             "rock_rotation_max_deg", "beyond_byerlee_m2"})
        measures.emplace_back(name, largest(column(name)));
    return measures;
}

NamedNumbers last_values(const Table& history, std::initializer_list<const char*> columns) {
    NamedNumbers values;
    for (const char* column : columns)
        if (history.has(column))
            values.emplace_back(column, history.get<double>(column).back());
    return values;
}

} // namespace listric
