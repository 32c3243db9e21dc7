#pragma once

#include "dem/event.hpp"

#include <memory>

namespace listric::dem {

/// Automatic fault detection (AFD) and weakening [paper, Fig. 4c, d; Table 1].
struct FaultWeakeningParameters {
    double interval = 5.0e4;        ///< time between scans, Delta t_w, a
    double strain_rate = 1.0e-13;   ///< least shear strain rate of a fault, 1/s
    double circle_diameters = 5.0;  ///< measure circle's diameter, mean disc diameters
    double strained_width = 0.6;    ///< width that the strain rate refers to, circle diameters
    double spacing_diameters = 5.0; ///< least distance to a more active fault, mean diameters
    /// Width of the weakened band, mean diameters. With the contacts to both sides the shear zone
    /// is three diameters wide, which the paper found efficient.
    double band_diameters = 2.0;
    double sound_share = 0.7;         ///< least share of sound discs in a band that is weakened
    int angles = 12;                  ///< fault angles tried per sampling point
    double youngest_sediment = 2.0e5; ///< sediment younger than this is left alone, a
    Material material{8.5e8, 3.19e8, 0.0, false}; ///< of weakened discs: MAT18-W, never bonded
    double update_interval = 2.5e3;               ///< time between property updates, a
    double mean_stress_ratio = 0.75; ///< mean stress in a fault over lithostatic stress
    double largest_change = 0.05;    ///< largest relative radius change per property update
};

/// Scans the hanging wall with a measure circle for planes whose two sides slid past each other,
/// and weakens the discs along the most active ones. Loose sediment is not looked at: it deforms
/// everywhere [paper, Fig. 5], and its base would be taken for a fault.
///
/// Its memory lists the fault segments found: centre x_m, y_m, dip direction angle_rad, slip_m of
/// the interval (> 0: the upper side of the plane moved along its direction), found_at_m.
class FaultWeakening : public Event {
public:
    FaultWeakening(const FaultWeakeningParameters& parameters, double extension_rate,
                   double gravity, double density);

    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;

private:
    FaultWeakeningParameters parameters_;
    double overburden_; ///< weight of rock, N/m^3
};

} // namespace listric::dem
