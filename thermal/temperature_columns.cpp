#include "thermal/temperature_columns.hpp"

#include <algorithm>
#include <cmath>

namespace listric::thermal {

using namespace dem;

/// From above down. Sites are wider apart the deeper they are.
std::vector<std::size_t> TemperatureColumns::sites_about(double x) const {
    std::vector<std::size_t> column;
    for (std::size_t i = 0; i < cells_.sites.count(); ++i)
        if (!cells_.is_new[i] && std::abs(cells_.sites.x[i] - x) <= 0.4 * cells_.sites.reach[i])
            column.push_back(i);
    std::ranges::sort(column, std::ranges::greater(),
                      [&](std::size_t i) { return cells_.sites.y[i]; });
    return column;
}

std::optional<Point> TemperatureColumns::crossing(double x, double temperature) const {
    const std::vector<std::size_t> column = sites_about(x);
    // By height: beside a cliff a site's own depth is none of this column's.
    double y = ground_.height(x), before = surface_;
    for (const std::size_t i : column) {
        const double at = cells_.temperature[i], its = cells_.sites.y[i];
        if (its >= y)
            continue;
        if (at >= temperature) {
            const double share = at > before ? (temperature - before) / (at - before) : 1.0;
            return Point{x, y + std::clamp(share, 0.0, 1.0) * (its - y)};
        }
        y = its;
        before = at;
    }
    return std::nullopt;
}

std::vector<Point> isotherm(const Heat& heat, const State& state, const RigidBase& base,
                            double temperature, std::span<const double> x) {
    const TemperatureColumns columns(heat, state, base);
    const double floor = heat.ends().floor;
    std::vector<Point> line;
    for (const double place : x) {
        const auto found = columns.crossing(place, temperature);
        line.push_back({place, found ? found->y - uplift_at(state, place) : floor});
    }
    return line;
}

} // namespace listric::thermal
