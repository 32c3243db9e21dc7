#pragma once

#include "dem/base/place.hpp"
#include "dem/state.hpp"

#include <optional>
#include <vector>

namespace listric::dem {

/// The ground that a falling disc meets: how high its centre comes to lie over discs and base.
class Ground {
public:
    /// @param largest_radius  of the discs that will be dropped, m
    Ground(const State& state, const RigidBase& base, double largest_radius);

    /// Resting place of a disc dropped at x, m: it rolls down to where two obstacles hold it. None
    /// outside the base.
    std::optional<Point> rest(double x, double radius) const;

    /// Lowest height, m, of a centre dropped at x; infinite outside the base.
    double height(double x, double radius) const;

    /// Whether discs keep the centre of one dropped anywhere from x = `from` to `to` above a
    /// height. To a thousandth of that distance; false where they do not, and perhaps where the
    /// base does.
    bool keeps_above(double height, double from, double to, double radius) const;

    /// Makes a disc part of the ground.
    void add(Point centre, double radius);

    double left() const { return left_; }
    double right() const { return left_ + width_ * static_cast<double>(columns_.size()); }

private:
    struct Obstacle {
        Point centre;
        double radius;
    };

    /// Discs, from the highest centre down: most are too low to be touched.
    using Column = std::vector<Obstacle>;

    std::size_t column(double x) const;
    double height_over_discs(double x, double radius) const;
    double clearance(Point p) const;

    /// Surfaces of the base. Where one ends at the start of another, as at the breakaway,
    /// they are joined: then what lies beyond their corner is outside.
    std::vector<Surface> surfaces_;
    BasePlace place_;
    double left_, width_, bottom_, largest_;
    std::vector<Column> columns_;
};

} // namespace listric::dem
