#include "fem/relaxation.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace listric::fem {

Maxwell maxwell(double step, double time) {
    const double steps = step > 0.0 ? step / time : 0.0;
    if (steps == 0.0)
        return {};
    return {std::exp(-steps), std::max(least_share, -std::expm1(-steps) / steps)};
}

NearestPoint::NearestPoint(std::span<const StressPoint> points) {
    assert(!points.empty());
    for (std::size_t k = 0; k < points.size(); ++k)
        by_x_.emplace_back(points[k].place, k);
    std::ranges::stable_sort(by_x_, {}, [](const auto& point) { return point.first.x; });
}

std::size_t NearestPoint::operator()(Vector place) const {
    const auto start = std::ranges::lower_bound(by_x_, place.x, {},
                                                [](const auto& point) { return point.first.x; });
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    const auto look = [&](const auto& point) { // false: all that follow are further away
        if (const double distance = norm(point.first - place); distance < least) {
            least = distance;
            nearest = point.second;
        }
        return (point.first.x - place.x) * (point.first.x - place.x) < least * least;
    };
    for (auto right = start; right != by_x_.end() && look(*right); ++right) {
    }
    for (auto left = start; left != by_x_.begin() && look(*--left);) {
    }
    return nearest;
}

namespace {

/// Sums over points of an element and a rock, for a plane through their stresses.
struct Plane {
    double count = 0.0;
    Vector middle; ///< of the places
    double xx = 0.0, xy = 0.0, yy = 0.0;
    std::array<double, 3> mean{};
    std::array<Vector, 3> slope{};
};

/// By point.
std::vector<Plane> planes_through(std::span<const StressPoint> points,
                                  std::span<const double> stress) {
    std::vector<Plane> planes(points.size());
    for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
        while (end < points.size() && points[end].cell == points[first].cell)
            ++end;
        for (std::size_t k = first; k < end; ++k) {
            Plane& p = planes[k];
            const auto each = [&](auto&& visit) {
                for (std::size_t i = first; i < end; ++i)
                    if (points[i].relaxation_time == points[k].relaxation_time)
                        visit(i);
            };
            each([&](std::size_t i) {
                p.count += 1.0;
                p.middle = p.middle + points[i].place;
                for (std::size_t c = 0; c < 3; ++c)
                    p.mean[c] += stress[3 * i + c];
            });
            p.middle = 1.0 / p.count * p.middle;
            for (double& mean : p.mean)
                mean /= p.count;
            each([&](std::size_t i) {
                const Vector d = points[i].place - p.middle;
                p.xx += d.x * d.x;
                p.xy += d.x * d.y;
                p.yy += d.y * d.y;
                for (std::size_t c = 0; c < 3; ++c)
                    p.slope[c] = p.slope[c] + (stress[3 * i + c] - p.mean[c]) * d;
            });
            const double determinant = p.xx * p.yy - p.xy * p.xy;
            const double spread = p.xx + p.yy;
            for (Vector& s : p.slope) // points in a line, or almost, have no plane
                s = determinant > 1e-4 * spread * spread
                        ? 1.0 / determinant *
                              Vector{p.yy * s.x - p.xy * s.y, p.xx * s.y - p.xy * s.x}
                        : Vector{};
        }
    }
    return planes;
}

} // namespace

std::vector<double> carried_over(std::span<const StressPoint> from, std::span<const double> stress,
                                 std::span<const StressPoint> to) {
    assert(stress.size() == 3 * from.size());
    std::vector<double> result(3 * to.size(), 0.0);
    if (from.empty())
        return result;
    const NearestPoint nearest(from);
    const std::vector<Plane> planes = planes_through(from, stress);
    for (std::size_t k = 0; k < to.size(); ++k) {
        const Plane& plane = planes[nearest(to[k].place)];
        for (std::size_t c = 0; c < 3; ++c)
            result[3 * k + c] = plane.mean[c] + dot(plane.slope[c], to[k].place - plane.middle);
    }
    return result;
}

} // namespace listric::fem
