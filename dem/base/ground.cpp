#include "dem/base/ground.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace listric::dem {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Surface> joined(const RigidBase& base) {
    std::vector<Surface> surfaces;
    for (const Surface& s : base.surfaces) {
        surfaces.push_back(s);
        for (const Surface& before : base.surfaces) {
            if (before.chain.back().end == s.chain.front().start &&
                before.translation == s.translation)
                surfaces.back().chain.insert(surfaces.back().chain.begin(), before.chain.begin(),
                                             before.chain.end());
        }
    }
    return surfaces;
}

} // namespace

Ground::Ground(const State& state, const RigidBase& base, double largest_radius)
    : surfaces_(joined(base)), place_(base_place(state)) {
    const ConstDiscColumns d = disc_columns(state);
    const auto [low_x, high_x] = std::ranges::minmax(d.x);
    const double largest = std::max(largest_radius, *std::ranges::max_element(d.radius));
    // A column and its two neighbours hold all discs that one dropped into it can touch.
    width_ = largest_radius + largest;
    largest_ = largest;
    left_ = low_x - width_;
    bottom_ = *std::ranges::min_element(d.y) - width_;
    columns_.resize(static_cast<std::size_t>((high_x - left_) / width_) + 2);

    // Only discs near the surface are ever touched.
    std::vector<double> top(columns_.size(), bottom_);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        double& t = top[column(d.x[i])];
        t = std::max(t, d.y[i]);
    }
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const std::size_t c = column(d.x[i]);
        double least = top[c];
        if (c > 0)
            least = std::min(least, top[c - 1]);
        if (c + 1 < top.size())
            least = std::min(least, top[c + 1]);
        if (d.y[i] >= least - 3.0 * width_)
            columns_[c].push_back({{d.x[i], d.y[i]}, d.radius[i]});
    }
    for (Column& discs : columns_)
        std::ranges::sort(discs, std::greater{}, [](const Obstacle& o) { return o.centre.y; });
}

std::size_t Ground::column(double x) const {
    const double c =
        std::clamp((x - left_) / width_, 0.0, static_cast<double>(columns_.size() - 1));
    return static_cast<std::size_t>(c);
}

double Ground::clearance(Point p) const {
    double least = infinity;
    for (const Surface& s : surfaces_)
        if (const auto foot = nearest(s, place_, p))
            least = std::min(least, foot->distance);
    return least;
}

double Ground::height_over_discs(double x, double radius) const {
    double highest = -infinity;
    const std::size_t c = column(x);
    const double most = radius + largest_; // above a disc's centre
    for (std::size_t k = c > 0 ? c - 1 : 0; k <= std::min(c + 1, columns_.size() - 1); ++k)
        for (const Obstacle& o : columns_[k]) {
            if (o.centre.y + most <= highest)
                break;
            const double reach = radius + o.radius, dx = x - o.centre.x;
            if (std::abs(dx) < reach)
                highest = std::max(highest, o.centre.y + std::sqrt(reach * reach - dx * dx));
        }
    return highest;
}

bool Ground::keeps_above(double height, double from, double to, double radius) const {
    // Over a disc height is a concave function of x, so it is least at an end.
    const auto keeps = [&](const Obstacle& o, double left, double right) {
        const double reach = radius + o.radius, above = height - o.centre.y;
        const double a = left - o.centre.x, b = right - o.centre.x;
        const double dx = std::max(std::abs(a), std::abs(b));
        return dx < reach && (above < 0.0 || reach * reach - dx * dx > above * above);
    };
    const double most = radius + largest_, shortest = 1e-3 * (to - from);
    const auto some_disc_keeps = [&](double left, double right) {
        const std::size_t first = column(left), last = column(right);
        for (std::size_t k = first > 0 ? first - 1 : 0;
             k <= std::min(last + 1, columns_.size() - 1); ++k)
            for (const Obstacle& o : columns_[k]) {
                if (o.centre.y + most <= height)
                    break;
                if (keeps(o, left, right))
                    return true;
            }
        return false;
    };
    for (double left = from, step = to - from; left < to;) {
        const double right = std::min(left + step, to);
        if (some_disc_keeps(left, right)) {
            left = right;
            step *= 2.0;
        } else {
            step = 0.5 * (right - left);
            if (step < shortest)
                return false;
        }
    }
    return true;
}

double Ground::height(double x, double radius) const {
    double low = std::max(height_over_discs(x, radius), bottom_);
    if (clearance({x, low}) >= radius)
        return low;
    // The base is higher than the discs here. Over a detachment that does not overhang, clearance
    // grows with height.
    double high = low + 4.0 * width_;
    while (clearance({x, high}) < radius) {
        high += 4.0 * (high - low);
        if (high - low > 5e4) // beyond a wall
            return infinity;
    }
    for (int n = 0; n < 60 && high - low > 1e-7; ++n) {
        const double middle = 0.5 * (low + high);
        (clearance({x, middle}) < radius ? low : high) = middle;
    }
    return high;
}

std::optional<Point> Ground::rest(double x, double radius) const {
    double y = height(x, radius);
    if (y == infinity)
        return std::nullopt;
    const double step = 0.05 * radius;
    // Down the slope to the lowest place within a step on either side. The ground jumps where the
    // disc passes another's flank: then there is lower ground beyond, and it rolls on.
    for (int rolls = 0; rolls < 1000; ++rolls) {
        const double direction = height(x - step, radius) < height(x + step, radius) ? -1.0 : 1.0;
        for (double next = height(x + direction * step, radius); next < y;
             next = height(x + direction * step, radius)) {
            x += direction * step;
            y = next;
        }
        constexpr double golden = 0.6180339887498949;
        double low = x - step, high = x + step;
        while (high - low > 1e-6) {
            const double a = high - golden * (high - low), b = low + golden * (high - low);
            if (height(a, radius) < height(b, radius))
                high = b;
            else
                low = a;
        }
        x = 0.5 * (low + high);
        y = height(x, radius);
        for (const double side : {low - 1e-6, high + 1e-6})
            if (const double lower = height(side, radius); lower < y - 1e-3) {
                x = side;
                y = lower;
            }
        if (height(x - 2e-6, radius) >= y - 1e-3 && height(x + 2e-6, radius) >= y - 1e-3)
            break;
    }
    if (y == infinity)
        return std::nullopt;
    return Point{x, y};
}

void Ground::add(Point centre, double radius) {
    Column& discs = columns_[column(centre.x)];
    const auto place = std::ranges::upper_bound(discs, centre.y, std::greater{},
                                                [](const Obstacle& o) { return o.centre.y; });
    discs.insert(place, {centre, radius});
}

} // namespace listric::dem
