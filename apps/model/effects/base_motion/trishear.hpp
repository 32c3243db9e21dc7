#pragma once

#include "apps/model/effects/base_motion/ground.hpp"
#include "dem/numbers/point.hpp"
#include "dem/state.hpp"

#include <optional>
#include <span>
#include <vector>

// Trishear (Erslev 1991, Geology 19, 617): rock on the moving side of a fault goes with it, and in
// a triangle that opens at the fault's tip the slip falls to nothing, at constant area (the linear
// field of Zehnder and Allmendinger 2000, J. Struct. Geol. 22, 1009).

namespace listric::effects::base_motion {

struct Trishear {
    double apical_angle = 1.0; ///< of the triangle, rad
    double propagation = 2.0;  ///< of the tip up the fault, over slip: P/S

    /// Where the tip is now; before slip it was at the fault's foot, the cover being whole.
    dem::Point tip_of(const SlippedFault& fault) const;
};

/// Where a point is after the slip.
dem::Point carried(dem::Point p, const Trishear& shear, const SlippedFault& fault);

/// The top of a marker horizon that was level.
struct MarkerTop {
    double level = 0.0;             ///< at the start, m
    std::vector<dem::Point> points; ///< now
};

struct TrishearFit : Trishear {
    double misfit = 0.0; ///< root mean square of vertical distances, m
};

/// Angle and propagation by which trishear of a known fault and slip comes closest to tops
/// (Levenberg-Marquardt from several starts). The tip begins at the base of the cover, which is
/// whole. None of fewer points than 8.
std::optional<TrishearFit> fit_trishear(std::span<const MarkerTop> tops, const SlippedFault& fault);

/// Tops of the rock at a fifth to four fifths of its thickness: discs that began within half a mean
/// diameter of them, each moved onto the level that it began at.
std::vector<MarkerTop> marker_tops(const dem::State& state, const SlippedFault& fault);

} // namespace listric::effects::base_motion
