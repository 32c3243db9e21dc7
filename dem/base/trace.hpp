#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace listric::dem {

// The wall of a base that deforms: the edge of its finite elements. Each face is a polynomial
// through degree + 1 nodes, X(t) = sum N_i(t) (x_i + u_i) with t from 0 to 1, and everything that
// the wall does to a disc is done at one point of it. Forces go back to the nodes by the same N_i:
// force, moment and virtual work are kept to round-off, in the deformed wall as well.

/// A point of the wall.
struct TracePoint {
    Foot foot;                    ///< as the disc sees it
    double place = 0.0;           ///< faces from the wall's start
    std::size_t node = 0;         ///< the face's first
    std::array<double, 3> weight; ///< N_i of the face's nodes; the third is 0 for degree 1
};

/// The wall's geometry: reference nodes from its start on, and their displacements.
class Trace {
public:
    Trace(std::span<const double> x, std::span<const double> y, std::span<const double> ux,
          std::span<const double> uy, int degree)
        : x_(x), y_(y), ux_(ux), uy_(uy), degree_(static_cast<std::size_t>(degree)) {}

    std::size_t faces() const { return (x_.size() - 1) / degree_; }
    Point node(std::size_t k) const { return {x_[k] + ux_[k], y_[k] + uy_[k]}; }

    /// Point of the wall closest to p. None beyond the wall's ends, except below its start, where
    /// the backstop ends and so the start itself is the nearest point: else a wall that tilts
    /// would open a gap there.
    /// @param place  where to begin, as found before; negative: search
    std::optional<TracePoint> nearest(Point p, double place = -1.0) const;

    Point at(double place) const;

private:
    /// X(t) = a + b t + c t^2.
    struct Face {
        Point a, b, c;
    };
    Face face(std::size_t k) const;
    std::size_t search(Point p) const;

    std::span<const double> x_, y_, ux_, uy_;
    std::size_t degree_;
};

/// N_i(t) of a face: of its start, end for degree 1; start, middle, end for degree 2.
std::array<double, 3> shape_functions(int degree, double t);

} // namespace listric::dem
