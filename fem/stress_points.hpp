#pragma once

#include "fem/vector.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace listric::fem {

/// A quadrature point of rock that relaxes. A stress there is its deviator's xx, yy and xy, Pa;
/// zz is what makes its trace 0.
struct StressPoint {
    Vector place;                 ///< m
    double relaxation_time = 0.0; ///< viscosity over shear modulus, s
    std::size_t cell = 0;         ///< number of its element
};

/// Finds the nearest of some points.
class NearestPoint {
public:
    explicit NearestPoint(std::span<const StressPoint> points); ///< at least one

    std::size_t operator()(Vector place) const; ///< its number

private:
    std::vector<std::pair<Vector, std::size_t>> by_x_;
};

/// Stresses at points of one mesh as those of another have them: from the plane through what an
/// element has at points of one rock.
std::vector<double> carried_over(std::span<const StressPoint> from, std::span<const double> stress,
                                 std::span<const StressPoint> to);

} // namespace listric::fem
