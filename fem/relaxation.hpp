#pragma once

// Rock whose deviatoric stress relaxes (Maxwell): over a step, and from mesh to mesh.

#include "fem/vector.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace listric::fem {

/// Over a step in which strain is straight in time, the stress at the step's end is decay times
/// that at its start and share times what elastic rock would have of the strain since. Exact for a
/// steady rate of strain, of second order in the step else.
struct Maxwell {
    double decay = 1.0;
    double share = 1.0; ///< of the shear modulus
};

/// Least share: with less, rock is incompressible to its elements.
inline constexpr double least_share = 0.002;

/// @param step  s; 0: rock answers at once
/// @param time  of relaxation, viscosity over shear modulus, s; infinite: rock is elastic
Maxwell maxwell(double step, double time);

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
