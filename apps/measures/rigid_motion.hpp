#pragma once

#include "dem/point.hpp"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace listric::measures {

/// Where a point was and where it is, m.
using Displaced = std::pair<dem::Point, dem::Point>;

/// Least-squares rotation of points, rad in (-pi, pi], counter-clockwise, about the centres of
/// where they were and where they are.
inline double rotation_about(std::span<const Displaced> points, dem::Point from, dem::Point to) {
    double sine = 0.0, cosine = 0.0;
    for (const auto& [before, after] : points) {
        const dem::Point a = before - from, b = after - to;
        sine += cross(a, b);
        cosine += dot(a, b);
    }
    return std::atan2(sine, cosine);
}

/// Least-squares rigid motion of points: add pairs, then fit once, then ask.
class RigidMotion {
public:
    void add(dem::Point from, dem::Point to) { points_.emplace_back(from, to); }
    std::size_t size() const { return points_.size(); }

    void fit() {
        const auto n = static_cast<double>(points_.size());
        from_ = to_ = {};
        for (const auto& [a, b] : points_) {
            from_ = {from_.x + a.x / n, from_.y + a.y / n};
            to_ = {to_.x + b.x / n, to_.y + b.y / n};
        }
        angle_ = rotation_about(points_, from_, to_);
    }

    double angle() const { return angle_; } ///< rad, counter-clockwise
    dem::Point move(dem::Point p) const {
        const double x = p.x - from_.x, y = p.y - from_.y;
        return {to_.x + std::cos(angle_) * x - std::sin(angle_) * y,
                to_.y + std::sin(angle_) * x + std::cos(angle_) * y};
    }

private:
    std::vector<Displaced> points_;
    dem::Point from_, to_;
    double angle_ = 0.0;
};

} // namespace listric::measures
