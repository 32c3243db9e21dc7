#pragma once

#include "dem/numbers/hypotenuse.hpp"

namespace listric::dem {

/// A place, m, or a vector in the plane.
struct Point {
    double x = 0.0, y = 0.0;
    bool operator==(const Point&) const = default;
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double factor, Point a) { return {factor * a.x, factor * a.y}; }

inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; } ///< > 0: b is left of a
inline double norm(Point a) { return hypotenuse(a.x, a.y); }
inline Point unit(Point a) { return (1.0 / norm(a)) * a; }

} // namespace listric::dem
