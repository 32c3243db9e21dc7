#pragma once

#include <cmath>

namespace listric::fem {

/// A place, displacement, force or traction in the section: x to the right, y up; SI units.
struct Vector {
    double x = 0.0, y = 0.0;
};

constexpr Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vector operator*(double f, Vector a) { return {f * a.x, f * a.y}; }
constexpr double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }

/// Area of the parallelogram; positive where b is to the left of a.
constexpr double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }

inline double norm(Vector a) { return std::hypot(a.x, a.y); }

} // namespace listric::fem
