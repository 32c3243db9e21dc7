#pragma once

#include "dem/numbers/point.hpp"
#include "dem/state.hpp"

#include <vector>

namespace listric::dem {

/// The surface of the hanging wall: the tops of the discs in columns one mean diameter wide,
/// averaged over five, so that it is smooth where the discs are rough.
class GroundLevel {
public:
    /// @param least_age  of sediment that counts: travel since it was laid down, m
    explicit GroundLevel(const State& state, double least_age = 0.0);

    double height(double x) const; ///< m, linear between the columns' middles

    /// Depth below it, m; negative above.
    double depth(Point p) const { return height(p.x) - p.y; }

private:
    double left_, width_;
    std::vector<double> heights_; ///< by column, m
};

} // namespace listric::dem
