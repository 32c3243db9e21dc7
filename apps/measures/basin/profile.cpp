#include "apps/measures/basin/profile.hpp"

#include "dem/base/place.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double smoothing = 1e3; ///< width of the moving average, m
constexpr double nothing_there = -std::numeric_limits<double>::infinity(); ///< height of no disc, m

/// Upper envelopes of discs, m, by column; -infinity where there is none.
struct Envelopes {
    std::vector<double> all, pre_rift;
};

/// @param x, y  of the discs, now or at their start, m
Envelopes envelopes(const ConstDiscColumns& d, std::span<const double> x, std::span<const double> y,
                    std::size_t columns, double width) {
    Envelopes top{std::vector<double>(columns, nothing_there),
                  std::vector<double>(columns, nothing_there)};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double column = x[i] / width;
        if (column < 0.0 || column >= static_cast<double>(columns))
            continue;
        const auto k = static_cast<std::size_t>(column);
        const double highest = y[i] + d.radius[i];
        top.all[k] = std::max(top.all[k], highest);
        if (d.stratum[i] == 0)
            top.pre_rift[k] = std::max(top.pre_rift[k], highest);
    }
    return top;
}

} // namespace

Profile measure_profile(const Setting& setting, const State& state, const RigidBase& base) {
    const Chain detachment = standing_base(base, state).surfaces.front().chain;
    const double width = 2.0 * state.mean_radius;
    const auto columns = static_cast<std::size_t>(
        (setting.length + wall_way(base, state.clock.extension.m)) / width);
    const ConstDiscColumns d = disc_columns(state);
    Envelopes top = envelopes(d, d.x, d.y, columns, width);
    Profile p;
    p.x.resize(columns);
    p.pre_rift_top = std::move(top.pre_rift);
    std::vector<double> thickness(columns);
    for (std::size_t k = 0; k < columns; ++k) {
        p.x[k] = (static_cast<double>(k) + 0.5) * width;
        p.pre_rift_top[k] = std::max(p.pre_rift_top[k], height_at(detachment, p.x[k]));
        thickness[k] = std::max(0.0, top.all[k] - p.pre_rift_top[k]);
    }
    p.sediment_thickness = smoothed(thickness, width);
    return p;
}

std::vector<double> smoothed(std::span<const double> values, double column) {
    const auto reach = static_cast<std::ptrdiff_t>(std::lround(0.5 * smoothing / column));
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    std::vector<double> result(values.size());
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const std::ptrdiff_t low = std::max<std::ptrdiff_t>(k - reach, 0);
        const std::ptrdiff_t high = std::min(k + reach, n - 1);
        result[static_cast<std::size_t>(k)] =
            std::accumulate(values.begin() + low, values.begin() + high + 1, 0.0) /
            static_cast<double>(high - low + 1);
    }
    return result;
}

std::vector<double> smoothed_depth(const Profile& profile) {
    std::vector<double> depth;
    for (double top : profile.pre_rift_top)
        depth.push_back(-top);
    const double column = profile.x.size() > 1 ? profile.x[1] - profile.x[0] : smoothing;
    return smoothed(depth, column);
}

double area_above(const Profile& profile, std::size_t columns, double width) {
    assert(columns <= profile.pre_rift_top.size());
    double area = 0.0;
    for (std::size_t k = 0; k < columns; ++k)
        area -= profile.pre_rift_top[k] * width;
    return area;
}

double area_above_start(const Setting& setting, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const double width = 2.0 * state.mean_radius;
    const auto columns = static_cast<std::size_t>(setting.length / width);
    double area = 0.0;
    for (const double top : envelopes(d, d.start_x, d.start_y, columns, width).pre_rift)
        if (top > nothing_there) // else it was eroded
            area -= top * width;
    return area;
}

std::optional<Point> find_cutoff(const State& state, const Chain& detachment) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::pair<double, double>> on_detachment; // arc length, radius
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] != 0)
            continue;
        if (const auto foot = foot_point(detachment, {d.x[i], d.y[i]});
            foot && foot->distance < d.radius[i] + 0.25 * state.mean_radius)
            on_detachment.emplace_back(foot->arc_length, d.radius[i]);
    }
    if (on_detachment.empty())
        return std::nullopt;
    const auto [arc_length, radius] = *std::ranges::min_element(on_detachment);
    const Point p = point_at(detachment, arc_length - radius);
    return Point{p.x, -p.y};
}

} // namespace listric::measures
