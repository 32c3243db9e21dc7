#include "dem/events/weakened_discs.hpp"

#include "dem/power_cell.hpp"

#include <algorithm>

namespace listric::dem {

std::vector<std::int32_t> weak_rows(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.material[i] == weak)
            rows.push_back(static_cast<std::int32_t>(i));
    return rows;
}

void add_weakened_columns(State& state) {
    state.discs.add_like<double>("scanned_x", "m", "x");
    state.discs.add_like<double>("scanned_y", "m", "y");
    state.discs.add<double>("rock_radius", "m", 0.0);
    state.discs.add<double>("rock_area", "m^2", 0.0);
    state.discs.add<double>("correction", "1", 1.0);
}

WeakenedColumns weakened_columns(State& state) {
    Table& t = state.discs;
    return {t.get<double>("scanned_x"), t.get<double>("scanned_y"), t.get<double>("rock_radius"),
            t.get<double>("rock_area"), t.get<double>("correction")};
}

double enlargement(double mean_stress, const Material& weak_material) {
    const double q = std::max(0.0, mean_stress) / (0.5 * weak_material.normal_stiffness);
    return 1.0 + q / (1.0 + 0.42 * q);
}

double weakened_volume_change(const State& state, const RigidBase& base) {
    const std::vector<std::int32_t> rows = weak_rows(state);
    const std::vector<PowerCell> cells = power_cells(state, base, rows);
    const auto rock_area = state.discs.get<double>("rock_area");
    double change = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (const double before = rock_area[static_cast<std::size_t>(rows[k])];
            before > 0.0 && cells[k].closed)
            change += cells[k].area - before;
    return change;
}

} // namespace listric::dem
