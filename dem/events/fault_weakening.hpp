#pragma once

#include "dem/event.hpp"

#include <memory>

namespace listric::dem {

/// Automatic fault detection (AFD) and weakening [paper, Fig. 4c, d; Table 1].
struct FaultWeakeningParameters {
    double interval = 5.0e4; ///< time between scans, Delta t_w, a
    /// Least slip of a fault between scans, d_cw, m: what the paper's 1e-13 per second makes in
    /// 50,000 a in its circle of five mean diameters of 186 m. In metres, a fault is a fault for
    /// discs of any size.
    double least_slip = 62.0;
    /// If not 0, what decides instead: the least shear strain rate in the measure circle, eps_cw,
    /// 1/s. The slip that it stands for is in proportion to the disc size.
    double strain_rate = 0.0;
    double circle_diameters = 5.0; ///< measure circle's diameter, mean disc diameters
    /// Least distance to a more active fault, mean diameters: five by the paper's text. Table 1 has
    /// "5e3 m, about 5 r", that is half of it, if it is meant to be 5e2 m; but then the bands,
    /// three diameters wide with their contacts, fill a zone of high strain side by side, which the
    /// distance is there to prevent.
    double spacing_diameters = 5.0;
    /// Width of the weakened band, mean diameters. With the contacts to both sides the shear zone
    /// is three diameters wide, which the paper found efficient.
    double band_diameters = 2.0;
    double sound_share = 0.7;         ///< least share of sound discs in a band that is weakened
    int angles = 12;                  ///< fault angles tried per sampling point
    double youngest_sediment = 2.0e5; ///< sediment younger than this is left alone, a
    bool whole_domain = false;        ///< looks at young and loose sediment, too [paper]
    double heal_after = 0.0;       ///< rest after which weakened rock is sound again, a; 0: never
    double resting_rate = 1.0e-15; ///< shear strain rate of rest, 1/s: below it bonds heal [paper]
    /// Rock of weakened discs, never bonded: MAT18-W with a friction that Table 1 does not have.
    Material material{8.5e8, 3.19e8, 0.2, false};
    double update_interval = 2.5e3;            ///< time between property updates, a
    double mean_stress_ratio = 0.75;           ///< mean stress in a fault over the weight above it
    double shortening_mean_stress_ratio = 1.0; ///< where the wall returns: thrusts stand under more
    double largest_change = 0.05; ///< largest relative radius change per property update
};

/// Mean stress in a fault over the weight above it, by the sense of the motion now.
inline double mean_stress_ratio(const FaultWeakeningParameters& p, const State& state,
                                const RigidBase& base) {
    return base.motion.shortens(state.clock.travel) ? p.shortening_mean_stress_ratio
                                                    : p.mean_stress_ratio;
}

/// Slip above which a plane is a fault, for discs of that mean diameter, m.
double critical_slip(const FaultWeakeningParameters& p, double mean_diameter);

/// Shear strain rate above which a plane is a fault, 1/s.
double critical_rate(const FaultWeakeningParameters& p, double mean_diameter);

/// Scans the hanging wall with a measure circle for planes whose two sides slid past each other,
/// and weakens the discs along the most active ones: a band as long as the circle at each, and the
/// gap between the bands of two that lie on one line, if it slips as well. Bands that are mostly
/// weak are known faults, hence the widest gap, `sound_share` times the circle, that neighbouring
/// bands would leave for good. Loose sediment is not looked at unless asked for: it deforms
/// everywhere [paper, Fig. 5], and its base would be taken for a fault.
///
/// In a pause nothing is weakened: what a scan finds there, at its start most of all, slipped
/// before. A fault that lost its strength at once would let the graben down though nothing pulls.
/// Its discs are weakened by the next scan in motion (column found_at_rest, from the first such
/// scan on).
///
/// With `heal_after` the years that a weakened disc has rested are a column, rested_a; once they
/// are enough the disc has the stiffness of its rock again, and the radius that carries its load
/// with it. Its bonds come by bond healing.
///
/// Its memory lists the fault segments found: centre x_m, y_m, dip direction angle_rad, slip_m of
/// the interval (> 0: the upper side of the plane moved along its direction), found_at_m (of
/// travel).
class FaultWeakening : public Event {
public:
    FaultWeakening(const FaultWeakeningParameters& parameters, const Calendar& calendar,
                   double gravity);

    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;

private:
    FaultWeakeningParameters parameters_;
    double gravity_; ///< m/s^2
};

} // namespace listric::dem
