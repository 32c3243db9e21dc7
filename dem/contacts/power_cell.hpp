#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <span>
#include <vector>

namespace listric::dem {

/// The part of the plane that belongs to a disc: the points whose power |p - c|^2 - r^2 is least
/// for it. Unlike a disc's own area it contains its share of the pores, and cells fill the plane.
struct PowerCell {
    double area = 0.0;   ///< m^2
    bool closed = false; ///< bounded by other discs and the base on all sides
};

/// Power cells of the discs of the given rows, from the discs within five mean radii. Weakened
/// discs count with the radius of the rock that they stand for: their enlargement is a spring's
/// travel, and would take area from their sound neighbours.
std::vector<PowerCell> power_cells(const State& state, const RigidBase& base,
                                   std::span<const std::int32_t> rows);

/// Radius of the rock that each disc stands for, m.
std::vector<double> rock_radii(const State& state);

} // namespace listric::dem
