#include "apps/measures/fault_throw.hpp"

#include "apps/measures/rigid_motion.hpp"
#include "apps/support/statistics.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/hypotenuse.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

// Mean diameters.
constexpr double nearest_disc = 3.0, farthest_disc = 12.0; ///< beside the trace
constexpr double extended = 15.0;                          ///< the trace, upward

/// Discs of one stratum on one side of a fault: sums for a line through them.
struct Side {
    double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;

    void add(double px, double py) {
        count += 1.0;
        x += px;
        y += py;
        xx += px * px;
        xy += px * py;
    }
    double spread() const { return xx - x * x / count; }
    double tilt_moment() const { return xy - x * y / count; }
};

/// Discs of a stratum beside a fault, m.
struct Stratum {
    std::vector<Point> left, right; ///< of the downward direction
};

/// The trace with its upper end drawn out straight.
Polyline extended_upward(const Polyline& trace, double length) {
    Polyline line = trace;
    const Point below = trace[std::min<std::size_t>(6, trace.size() - 1)];
    const Point up = trace.front() - below;
    const double d = norm(up);
    line.insert(line.begin(),
                {trace.front().x + length * up.x / d, trace.front().y + length * up.y / d});
    return line;
}

/// Discs beside a line by stratum; of the pre-rift rock its top.
std::map<int, Stratum> strata_beside(const State& state, const Polyline& line, double diameter) {
    const ConstDiscColumns d = disc_columns(state);
    std::map<int, Stratum> strata;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0 && d.start_y[i] < -1.5 * diameter)
            continue;
        const PolylinePlace place = place_on(line, {d.x[i], d.y[i]});
        if (place.beyond || std::abs(place.distance) > farthest_disc * diameter)
            continue;
        Stratum& stratum = strata[d.stratum[i]];
        (place.distance > 0.0 ? stratum.left : stratum.right).push_back({d.x[i], d.y[i]});
    }
    return strata;
}

double mean_height(const std::vector<Point>& discs) {
    double sum = 0.0;
    for (Point p : discs)
        sum += p.y;
    return sum / static_cast<double>(discs.size());
}

/// The discs around where the line crosses a stratum, in upright windows: slanted ones, as wide as
/// the fault is near, would bend the lines. None if the line does not cross it.
std::optional<std::pair<Side, Side>> sides_of(const Stratum& stratum, const Polyline& line,
                                              double diameter) {
    if (stratum.left.empty() || stratum.right.empty())
        return std::nullopt;
    const double y = 0.5 * (mean_height(stratum.left) + mean_height(stratum.right));
    const auto next = std::ranges::find_if(line, [&](Point p) { return p.y < y; });
    if (next == line.begin() || next == line.end())
        return std::nullopt;
    const Point a = *(next - 1), b = *next;
    const double x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
    const auto fill = [&](const std::vector<Point>& discs) {
        Side side;
        for (Point p : discs)
            if (const double distance = std::abs(p.x - x);
                distance > nearest_disc * diameter && distance < farthest_disc * diameter)
                side.add(p.x - x, p.y - y);
        return side;
    };
    return std::pair{fill(stratum.left), fill(stratum.right)};
}

/// Height of the left side's line over the right side's, m. None if a side has too few discs.
std::optional<double> step_between(const Side& left, const Side& right) {
    constexpr double fewest = 6.0; // discs on a side
    if (left.count < fewest || right.count < fewest)
        return std::nullopt;
    const double tilt =
        (left.tilt_moment() + right.tilt_moment()) / (left.spread() + right.spread());
    return (left.y - tilt * left.x) / left.count - (right.y - tilt * right.x) / right.count;
}

/// Height of the trace, and of the layer beside it at the start, m.
struct Layer {
    double now, start;
};

/// Layers along one side of a trace, from top to bottom.
/// @param offset  of the discs that say so, m into the footwall
std::vector<Layer> layers_beside(const State& state, const Cells& cells, const Polyline& trace,
                                 double offset, double reach) {
    constexpr std::size_t fewest = 8; // discs beside a point
    const ConstDiscColumns d = disc_columns(state);
    std::vector<Layer> layers;
    for (std::size_t k = 0; k < trace.size(); ++k) {
        const Point centre = trace[k] + offset * footwall_normal(trace, k);
        RigidMotion back;
        cells.for_each_near(centre.x, centre.y, [&](std::int32_t row) {
            const auto i = static_cast<std::size_t>(row);
            if (d.stratum[i] == 0 && hypotenuse(d.x[i] - centre.x, d.y[i] - centre.y) < reach)
                back.add({d.x[i], d.y[i]}, {d.start_x[i], d.start_y[i]});
        });
        if (back.size() < fewest)
            continue;
        back.fit();
        // Above the pre-rift top there is no layer that the side's motion could bring back.
        if (const double start = back.move(trace[k]).y; start <= 0.0)
            layers.push_back({trace[k].y, start});
    }
    return layers;
}

} // namespace

std::map<int, double> fault_throws(const State& state, const Polyline& trace) {
    assert(trace.size() > 1);
    const double diameter = 2.0 * state.mean_radius;
    const Polyline line = extended_upward(trace, extended * diameter);
    std::map<int, double> throws;
    for (const auto& [number, stratum] : strata_beside(state, line, diameter))
        if (const auto sides = sides_of(stratum, line, diameter))
            if (const auto step = step_between(sides->first, sides->second))
                throws[number] = falls_right(line) ? -*step : *step;
    return throws;
}

std::optional<double> pre_rift_throw(const State& state, const Polyline& trace) {
    assert(trace.size() > 1);
    constexpr std::size_t fewest = 4; // layers
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const double reach = 3.0 * diameter, offset = 6.0 * diameter;
    const Cells cells(d.x, d.y, reach);
    const std::vector<Layer> footwall = layers_beside(state, cells, trace, offset, reach);
    const std::vector<Layer> hanging_wall = layers_beside(state, cells, trace, -offset, reach);
    std::vector<double> throws;
    for (const Layer& layer : hanging_wall)
        for (std::size_t k = 0; k + 1 < footwall.size(); ++k) {
            const Layer &up = footwall[k], &down = footwall[k + 1];
            if (up.start >= layer.start && down.start < layer.start) {
                const double share = (up.start - layer.start) / (up.start - down.start);
                throws.push_back(up.now + share * (down.now - up.now) - layer.now);
                break;
            }
        }
    return throws.size() < fewest ? std::nullopt : std::optional(median(std::move(throws)));
}

} // namespace listric::measures
