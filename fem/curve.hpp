#pragma once

#include "fem/request.hpp"

#include <utility>
#include <vector>

namespace listric::fem {

/// Direction of travel, rad, and unit vector along a piece after `arc_length` m.
double direction_at(const Piece& piece, double arc_length);
Vector tangent_at(const Piece& piece, double arc_length);
Vector point_at(const Piece& piece, double arc_length);

/// Pieces joined end to end, with arc length counted from the first one's start. An empty curve has
/// no points: only its length and its offset may be asked for.
class Curve {
public:
    Curve() = default;
    explicit Curve(std::vector<Piece> pieces);

    bool empty() const { return pieces_.empty(); }
    const std::vector<Piece>& pieces() const { return pieces_; }
    double length() const { return empty() ? 0.0 : ends_.back(); }
    Vector at(double arc_length) const;     ///< beyond the ends: along the end's tangent
    double dip_at(double arc_length) const; ///< rad below the horizontal

    /// Arc length of the closest point.
    double nearest(Vector p) const;
    double distance(Vector p) const; ///< m, never negative

    /// Arc lengths at which the dip passes through 45 degrees, with it on either side; kinks count.
    std::vector<double> turns() const;

    /// Arc length at which the curve, which never rises, is at height y.
    double where_y(double y) const;

    /// The curve at `distance` m to its right, the footwall's side. Bends too tight for it become
    /// corners, gaps at kinks are closed along the tangents.
    Curve offset(double distance) const;

private:
    /// The piece at an arc length, and the arc length from its start. The ends' pieces go on
    /// beyond.
    std::pair<const Piece&, double> on_piece(double arc_length) const;

    std::vector<Piece> pieces_;
    std::vector<double> ends_; ///< arc length at the end of each piece
};

} // namespace listric::fem
