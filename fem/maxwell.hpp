#pragma once

#include <algorithm>
#include <cmath>

namespace listric::fem {

/// Rock whose deviatoric stress relaxes (Maxwell), over a step in which its strain is straight in
/// time: the stress at the step's end is decay times that at its start and share times what elastic
/// rock would have of the strain since. Exact for a steady rate of strain, second order in the step
/// else.
struct Maxwell {
    double decay = 1.0;
    double share = 1.0; ///< of the shear modulus
};

/// Least share: with less, rock is incompressible to its elements.
inline constexpr double least_share = 0.002;

/// @param step  s; 0: rock answers at once
/// @param time  of relaxation, viscosity over shear modulus, s; infinite: rock is elastic
inline Maxwell maxwell(double step, double time) {
    const double steps = step > 0.0 ? step / time : 0.0;
    if (steps == 0.0)
        return {};
    return {std::exp(-steps), std::max(least_share, -std::expm1(-steps) / steps)};
}

} // namespace listric::fem
