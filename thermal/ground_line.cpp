#include "thermal/ground_line.hpp"

#include "dem/base/ground_level.hpp"
#include "dem/base/place.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace listric::thermal {

using namespace dem;

GroundLine::GroundLine(std::vector<Point> points, std::vector<double> sediment)
    : points_(std::move(points)), sediment_(std::move(sediment)) {
    assert(!points_.empty() && (sediment_.empty() || sediment_.size() == points_.size()));
}

/// Number of the first point beyond x.
std::size_t GroundLine::after(double x) const {
    const auto place = std::ranges::upper_bound(points_, x, {}, &Point::x);
    return static_cast<std::size_t>(place - points_.begin());
}

double GroundLine::height(double x) const {
    const std::size_t k = after(x);
    if (k == 0)
        return points_.front().y;
    if (k == points_.size())
        return points_.back().y;
    const Point a = points_[k - 1], b = points_[k];
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

double GroundLine::sediment(double x) const {
    if (sediment_.empty())
        return 0.0;
    const std::size_t k = after(x);
    if (k == 0)
        return sediment_.front();
    if (k == points_.size())
        return sediment_.back();
    const double share = (x - points_[k - 1].x) / (points_[k].x - points_[k - 1].x);
    return sediment_[k - 1] + share * (sediment_[k] - sediment_[k - 1]);
}

double GroundLine::highest() const { return std::ranges::max(points_, {}, &Point::y).y; }

std::optional<Foot> GroundLine::nearest(Point p, double within) const {
    const double above = -depth(p);
    double best = std::abs(above);
    Foot foot{best, {0.0, -1.0}};
    bool found = best <= within;
    best = std::min(best, within);
    const std::size_t end = std::min(after(p.x + within) + 1, points_.size());
    for (std::size_t k = std::max<std::size_t>(after(p.x - within), 1); k < end; ++k) {
        const Point a = points_[k - 1], b = points_[k], along{b.x - a.x, b.y - a.y};
        const double square = along.x * along.x + along.y * along.y;
        if (square == 0.0)
            continue;
        const double share =
            std::clamp(((p.x - a.x) * along.x + (p.y - a.y) * along.y) / square, 0.0, 1.0);
        const Point way{p.x - a.x - share * along.x, p.y - a.y - share * along.y};
        const double distance = hypotenuse(way.x, way.y);
        if (distance > best)
            continue;
        found = true;
        best = distance;
        const double length = std::sqrt(square);
        foot = {distance, {along.y / length, -along.x / length}};
        const bool is_corner = share == 0.0 || share == 1.0;
        if (is_corner && above < 0.0 && distance > 1e-6 * length)
            foot.normal = {way.x / distance, way.y / distance};
    }
    if (!found)
        return std::nullopt;
    if (above > 0.0)
        foot.distance = -foot.distance;
    return foot;
}

std::vector<Point> base_points(const State& state, const RigidBase& base, double step) {
    const RigidBase standing = standing_base(base, state);
    const Chain& chain = standing.surfaces.front().chain;
    const double length = length_of(chain);
    const auto parts = static_cast<std::size_t>(std::ceil(length / step));
    std::vector<Point> points;
    for (std::size_t k = 0; k <= parts; ++k)
        points.push_back(point_at(chain, length * static_cast<double>(k) /
                                             static_cast<double>(std::max<std::size_t>(parts, 1))));
    return points;
}

double uplift_at(const State& state, double x) {
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    if (nodes.x.empty())
        return 0.0;
    std::size_t k = 1;
    while (k + 1 < nodes.x.size() && nodes.x[k] + nodes.ux[k] < x)
        ++k;
    const double x0 = nodes.x[k - 1] + nodes.ux[k - 1], x1 = nodes.x[k] + nodes.ux[k];
    const double share = std::clamp((x - x0) / (x1 - x0), 0.0, 1.0);
    constexpr double bends_in = 50e3; // m
    const double beyond = std::max({0.0, x0 - x, x - x1});
    return (nodes.uy[k - 1] + share * (nodes.uy[k] - nodes.uy[k - 1])) *
           (beyond > 0.0 ? exponential(-beyond / bends_in) : 1.0);
}

namespace {

/// A ground that is made from left to right.
struct Ground {
    std::vector<Point> points;
    std::vector<double> sediment; ///< by point

    void add(Point p, double its_sediment = 0.0) {
        points.push_back(p);
        sediment.push_back(its_sediment);
    }
};

/// Thickness of the discs' sediment at x.
double sediment_of_discs(const State& state, const GroundLevel& level, double x) {
    const GroundLevel rock(state, std::numeric_limits<double>::infinity());
    return std::max(0.0, level.height(x) - rock.height(x));
}

/// Ways from the hanging wall at which the ground beside it is known: wider and wider apart.
std::vector<double> ways_beside(double step) {
    constexpr double farthest = 300e3, growth = 1.25; // m; of the way
    std::vector<double> ways;
    for (double way = step; way < farthest; way *= growth)
        ways.push_back(way);
    return ways;
}

/// The rock left of x.
void add_left(Ground& ground, const State& state, const GroundBeside& beside, double left,
              double step) {
    const auto add = [&](double x) {
        const Cover cover = beside.cover ? beside.cover(x) : Cover();
        ground.add({x, beside.left + uplift_at(state, x) + cover.height}, cover.sediment);
    };
    const std::vector<double> ways = ways_beside(step);
    for (auto way = ways.rbegin(); way != ways.rend(); ++way)
        add(left - *way);
    add(left);
}

/// The rock right of the wall, with the sediment on it.
void add_right(Ground& ground, const State& state, const GroundBeside& beside,
               const GroundLevel& level, double wall, double step) {
    const double most = beside.film ? sediment_of_discs(state, level, wall) : 0.0;
    std::optional<TargetLine> target;
    if (most > 0.0)
        target = beside.film->target_at(state.clock.travel);
    const auto add = [&](double x, double of) {
        const double rock = beside.right + uplift_at(state, of);
        const double sediment = target ? std::clamp(target->height(of) - rock, 0.0, most) : 0.0;
        ground.add({x, rock + sediment}, sediment);
    };
    const double right = std::max(wall, ground.points.back().x);
    add(right, wall);
    for (const double way : ways_beside(step))
        add(right + way, right + way);
}

} // namespace

GroundLine ground_line(const State& state, const RigidBase& base, const GroundBeside& beside,
                       double least_age) {
    const double step = 2.0 * state.mean_radius;
    const double wall = beside.wall_x + wall_way(base, state.clock.extension.m);
    const std::vector<Point> trace = base_points(state, base, step);
    const double left = trace.front().x;
    Ground ground;
    add_left(ground, state, beside, left, step);
    const GroundLevel level(state, least_age);
    std::size_t next = 0;
    const auto base_height = [&](double x) {
        while (next + 1 < trace.size() && trace[next + 1].x <= x)
            ++next;
        if (next + 1 == trace.size())
            return trace.back().y;
        const Point a = trace[next], b = trace[next + 1];
        return b.x > a.x ? a.y + (b.y - a.y) * std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0) : a.y;
    };
    // A bare scarp may be steeper than columns are wide: it goes point by point.
    for (const Point& p : trace)
        if (p.x > ground.points.back().x && p.x < left + step && p.y > level.height(p.x))
            ground.add(p);
    for (double x = left + 0.5 * step; x < wall; x += step)
        if (x > ground.points.back().x)
            ground.add({x, std::max(level.height(x), base_height(x))});
    add_right(ground, state, beside, level, wall, step);
    return GroundLine(std::move(ground.points), std::move(ground.sediment));
}

} // namespace listric::thermal
