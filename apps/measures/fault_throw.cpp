#include "apps/measures/fault_throw.hpp"

#include "apps/measures/rigid_motion.hpp"
#include "apps/support/statistics.hpp"
#include "dem/cells.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

namespace {

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

} // namespace

std::map<int, double> fault_throws(const State& state, const std::vector<Point>& trace) {
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    constexpr double nearest = 3.0, farthest = 12.0, extended = 15.0; // mean diameters
    constexpr double fewest = 6.0;                                    // discs on a side

    std::vector<Point> line = trace;
    const Point below = trace[std::min<std::size_t>(6, trace.size() - 1)];
    const double dx = trace.front().x - below.x, dy = trace.front().y - below.y;
    const double length = std::hypot(dx, dy);
    line.insert(line.begin(), {trace.front().x + extended * diameter * dx / length,
                               trace.front().y + extended * diameter * dy / length});
    const bool falls_right = line.back().x > line.front().x;

    struct Layer {
        std::vector<Point> left, right; ///< of the downward direction
    };
    std::map<int, Layer> layers;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0 && d.start_y[i] < -1.5 * diameter)
            continue;
        const PolylinePlace place = place_on(line, {d.x[i], d.y[i]});
        if (place.beyond || std::abs(place.distance) > farthest * diameter)
            continue;
        Layer& layer = layers[d.stratum[i]];
        (place.distance > 0.0 ? layer.left : layer.right).push_back({d.x[i], d.y[i]});
    }
    // Upright windows: slanted ones, as wide as the fault is near, would bend the lines.
    std::map<int, std::pair<Side, Side>> sides;
    for (const auto& [stratum, layer] : layers) {
        if (layer.left.empty() || layer.right.empty())
            continue;
        const auto height = [](const std::vector<Point>& discs) {
            double sum = 0.0;
            for (Point p : discs)
                sum += p.y;
            return sum / static_cast<double>(discs.size());
        };
        const double y = 0.5 * (height(layer.left) + height(layer.right));
        const auto next = std::ranges::find_if(line, [&](Point p) { return p.y < y; });
        if (next == line.begin() || next == line.end())
            continue;
        const Point a = *(next - 1), b = *next;
        const double x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
        const auto fill = [&](Side& side, const std::vector<Point>& discs) {
            for (Point p : discs)
                if (const double distance = std::abs(p.x - x);
                    distance > nearest * diameter && distance < farthest * diameter)
                    side.add(p.x - x, p.y - y);
        };
        fill(sides[stratum].first, layer.left);
        fill(sides[stratum].second, layer.right);
    }
    std::map<int, double> throws;
    for (const auto& [stratum, pair] : sides) {
        const auto& [left, right] = pair;
        if (left.count < fewest || right.count < fewest)
            continue;
        const double tilt =
            (left.tilt_moment() + right.tilt_moment()) / (left.spread() + right.spread());
        const double step =
            (left.y - tilt * left.x) / left.count - (right.y - tilt * right.x) / right.count;
        throws[stratum] = falls_right ? -step : step;
    }
    return throws;
}

std::optional<double> pre_rift_throw(const State& state, const std::vector<Point>& trace) {
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const double reach = 3.0 * diameter, offset = 6.0 * diameter;
    const Cells cells(d.x, d.y, reach);
    const bool falls_right = trace.back().x > trace.front().x;
    /// Height of the trace, and of the layer beside it at the start, from top to bottom.
    struct Layer {
        double now, start;
    };
    std::vector<Layer> sides[2]; // footwall, hanging wall
    for (std::size_t k = 0; k < trace.size(); ++k) {
        const Point a = trace[k > 3 ? k - 3 : 0], b = trace[std::min(k + 3, trace.size() - 1)];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        // On the right of the downward direction lies the footwall of a fault that falls right.
        const double sign = falls_right ? 1.0 : -1.0;
        const Point n{sign * (b.y - a.y) / length, -sign * (b.x - a.x) / length};
        for (int side : {0, 1}) {
            const double away = side == 0 ? offset : -offset;
            const Point centre{trace[k].x + away * n.x, trace[k].y + away * n.y};
            RigidMotion back;
            cells.for_each_near(centre.x, centre.y, [&](std::int32_t row) {
                const auto i = static_cast<std::size_t>(row);
                if (d.stratum[i] == 0 && std::hypot(d.x[i] - centre.x, d.y[i] - centre.y) < reach)
                    back.add({d.x[i], d.y[i]}, {d.start_x[i], d.start_y[i]});
            });
            if (back.size() < 8)
                continue;
            back.fit();
            // Above the pre-rift top there is no layer that the side's motion could bring back.
            if (const double start = back.move(trace[k]).y; start <= 0.0)
                sides[side].push_back({trace[k].y, start});
        }
    }
    std::vector<double> throws;
    for (const Layer& layer : sides[1])
        for (std::size_t k = 0; k + 1 < sides[0].size(); ++k) {
            const Layer &up = sides[0][k], &down = sides[0][k + 1];
            if (up.start >= layer.start && down.start < layer.start) {
                const double share = (up.start - layer.start) / (up.start - down.start);
                throws.push_back(up.now + share * (down.now - up.now) - layer.now);
                break;
            }
        }
    if (throws.size() < 4)
        return std::nullopt;
    return median(std::move(throws));
}

} // namespace listric
