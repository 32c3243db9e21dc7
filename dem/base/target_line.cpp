#include "dem/base/target_line.hpp"

#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace listric::dem {

TargetLine::TargetLine(std::vector<Point> points) : points_(std::move(points)) {
    assert(!points_.empty() && std::ranges::is_sorted(points_, {}, &Point::x));
}

double TargetLine::height(double x) const {
    const auto next = std::ranges::upper_bound(points_, x, {}, &Point::x);
    if (next == points_.begin())
        return points_.front().y;
    if (next == points_.end())
        return points_.back().y;
    const Point a = *(next - 1), b = *next;
    return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
}

double TargetLine::above(Point p) const {
    const double vertical = p.y - height(p.x);
    double least = std::abs(vertical);
    // Only what is closer along x than the line below or above can be closer at all.
    const auto first = std::ranges::lower_bound(points_, p.x - least, {}, &Point::x);
    const auto last = std::ranges::upper_bound(points_, p.x + least, {}, &Point::x);
    const auto consider = [&](Point a, Point b) {
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double t =
            std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        least = std::min(least, hypotenuse(p.x - a.x - t * dx, p.y - a.y - t * dy));
    };
    for (auto k = first == points_.begin() ? first : first - 1;
         k != points_.end() && k + 1 != points_.end() && k != last; ++k)
        consider(*k, *(k + 1));
    return vertical < 0.0 ? -least : least;
}

Target::Target(double level, std::vector<TargetStage> stages) : stages_(std::move(stages)) {
    if (stages_.empty())
        stages_.push_back({0.0, {{0.0, level}}});
    assert(std::ranges::is_sorted(stages_, {}, &TargetStage::time));
}

TargetLine Target::at(double time) const {
    const auto next = std::ranges::upper_bound(stages_, time, {}, &TargetStage::time);
    if (next == stages_.begin())
        return TargetLine(stages_.front().points);
    if (next == stages_.end())
        return TargetLine(stages_.back().points);
    const TargetStage &a = *(next - 1), &b = *next;
    const TargetLine before(a.points), after(b.points);
    const double share = (time - a.time) / (b.time - a.time);
    std::vector<Point> points = a.points;
    points.insert(points.end(), b.points.begin(), b.points.end());
    std::ranges::sort(points, {}, &Point::x);
    const auto same_x = [](const Point& p, const Point& q) { return p.x == q.x; };
    points.erase(std::unique(points.begin(), points.end(), same_x), points.end());
    for (Point& p : points)
        p.y = (1.0 - share) * before.height(p.x) + share * after.height(p.x);
    return TargetLine(std::move(points));
}

} // namespace listric::dem
