#pragma once

#include "dem/numbers/elementary.hpp"
#include "dem/numbers/point.hpp"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace listric::measures {

/// Least-squares rigid motion of points: add at least one pair, then fit once, then ask.
class RigidMotion {
public:
    void add(dem::Point from, dem::Point to) { pairs_.emplace_back(from, to); }
    std::size_t size() const { return pairs_.size(); }

    void fit() {
        assert(!pairs_.empty());
        const auto n = static_cast<double>(pairs_.size());
        for (const auto& [a, b] : pairs_) {
            from_ = {from_.x + a.x / n, from_.y + a.y / n};
            to_ = {to_.x + b.x / n, to_.y + b.y / n};
        }
        double sine = 0.0, cosine = 0.0;
        for (const auto& [a, b] : pairs_) {
            const double ax = a.x - from_.x, ay = a.y - from_.y;
            const double bx = b.x - to_.x, by = b.y - to_.y;
            sine += ax * by - ay * bx;
            cosine += ax * bx + ay * by;
        }
        angle_ = dem::arc_tangent(sine, cosine);
        sine_ = dem::sine(angle_);
        cosine_ = dem::cosine(angle_);
    }

    double angle() const { return angle_; } ///< rad, counter-clockwise
    dem::Point move(dem::Point p) const {
        const double x = p.x - from_.x, y = p.y - from_.y;
        return {to_.x + cosine_ * x - sine_ * y, to_.y + sine_ * x + cosine_ * y};
    }

private:
    std::vector<std::pair<dem::Point, dem::Point>> pairs_;
    dem::Point from_, to_;
    double angle_ = 0.0, sine_ = 0.0, cosine_ = 1.0;
};

} // namespace listric::measures
