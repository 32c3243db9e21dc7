#pragma once

#include "dem/numbers/point.hpp"

#include <optional>
#include <span>

namespace listric::measures {

/// A disc near a horizon, and its height above it at its start (m), or only whether it is above: 1,
/// or -1.
struct Mark {
    dem::Point at; ///< m
    double above = 0.0;
};

/// Sums over marks about their mean.
struct MarkMoments {
    double count = 0.0, above = 0.0;
    dem::Point at;
    double xx = 0.0, xy = 0.0, yy = 0.0, x_above = 0.0, y_above = 0.0, above_above = 0.0;

    explicit MarkMoments(std::span<const Mark> marks);

    /// Adds the spread of other marks, not their place.
    void add_spread(const MarkMoments& other);
};

/// Height above a horizon (or only its sign) as a plane over the section; the horizon is where it
/// is 0.
class BedPlane {
public:
    /// Through the middle of marks, with the slope that `spread`, of these or more, asks for. None
    /// where they lie on a line, so that there is no slope across it.
    static std::optional<BedPlane> through(const MarkMoments& marks, const MarkMoments& spread);

    double above(dem::Point p) const { return above_ + dot(slope_, p - at_); }
    double standard_error(dem::Point p) const; ///< of that
    dem::Point slope() const { return slope_; }
    dem::Point middle() const { return at_; }

private:
    BedPlane() = default;

    dem::Point at_, slope_;
    double above_ = 0.0, count_ = 0.0, variance_ = 0.0;
    double xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;
};

} // namespace listric::measures
