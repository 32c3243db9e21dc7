#include "dem/contacts/grain_columns.hpp"

#include "dem/base/ground_level.hpp"
#include "dem/contacts/power_cell.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace listric::dem {

GrainColumns::GrainColumns(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const double left = std::ranges::min(d.x), width = 4.0 * state.mean_radius;
    std::vector<std::int32_t> column; // by row
    for (const double x : d.x)
        column.push_back(static_cast<std::int32_t>((x - left) / width));
    order_.resize(column.size());
    std::iota(order_.begin(), order_.end(), 0);
    const auto key = [&](std::int32_t row) {
        const auto i = static_cast<std::size_t>(row);
        return std::tuple(column[i], -d.y[i], row);
    };
    sort_shared(std::span(order_), [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    const auto column_at = [&](std::size_t k) {
        return column[static_cast<std::size_t>(order_[k])];
    };
    for (std::size_t k = 1; k <= order_.size(); ++k)
        if (k == order_.size() || column_at(k) != column_at(k - 1))
            ends_.push_back(k);
}

std::vector<double> grains_above(const State& state, std::span<const double> porosity) {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> radius = rock_radii(state);
    const GroundLevel ground(state);
    std::vector<double> height(d.x.size());
    GrainColumns(state).for_each([&](std::span<const std::int32_t> rows) {
        double grains = 0.0, all = 0.0; // m^2 over pi
        for (const std::int32_t row : rows) {
            const auto i = static_cast<std::size_t>(row);
            const double half = 0.5 * radius[i] * radius[i];
            const double half_grains = half * (d.stratum[i] > 0 ? 1.0 - porosity[i] : 1.0);
            const double depth = std::max(0.0, ground.depth({d.x[i], d.y[i]}));
            height[i] = depth * (grains + half_grains) / (all + half);
            grains += 2.0 * half_grains;
            all += 2.0 * half;
        }
    });
    return height;
}

} // namespace listric::dem
