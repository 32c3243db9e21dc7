#pragma once

// Which stress rock bears before planes in it slide. Stresses in Pa, compression positive.

#include <algorithm>
#include <cmath>

namespace listric::fem {

/// A plane slides where its shear stress exceeds cohesion + friction * normal stress.
struct CoulombLine {
    double friction = 0.0, cohesion = 0.0; ///< 1, Pa

    /// Whether some plane slides under the stress whose Mohr circle has this centre and radius.
    bool is_crossed_by(double centre, double radius) const {
        // In double, compiler and C library differ in the last bit of hypot(1, 0.6).
        const auto slope = static_cast<double>(std::hypot(1.0L, friction));
        return radius * slope > cohesion + friction * centre;
    }

    /// The largest axial stress at a confining stress, the Mohr circle's other end.
    double axial(double confining) const {
        const double root = std::sqrt(friction * friction + 1.0) + friction;
        return root * root * confining + 2.0 * cohesion * root;
    }
};

/// Byerlee's law (1978) [paper, "Brittle deformation"]: tau = 0.85 sigma_n below 200 MPa, else
/// 60 MPa + 0.6 sigma_n. Whichever line is lower holds.
inline constexpr CoulombLine byerlee_low{0.85, 0.0}, byerlee_high{0.6, 60e6};

inline bool beyond_byerlee(double centre, double radius) {
    return byerlee_low.is_crossed_by(centre, radius) || byerlee_high.is_crossed_by(centre, radius);
}

inline double byerlee_axial(double confining) {
    return std::min(byerlee_low.axial(confining), byerlee_high.axial(confining));
}

} // namespace listric::fem
