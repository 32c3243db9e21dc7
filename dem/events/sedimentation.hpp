#pragma once

#include "dem/event.hpp"

namespace listric {

/// Syn-rift sedimentation to a target level [paper, "Syn-rift sedimentation"; Table 1].
struct SedimentationParameters {
    double interval = 5.0e4;       ///< time between sedimentations, Delta t_s, a
    double level = 0.0;            ///< target level above the original surface, m
    double surface_porosity = 0.5; ///< Phi_ini
    double grain_density = 2600.0; ///< density at zero porosity, kg/m^3
    Material material = {};        ///< of sediment discs: bonded by healing only
};

/// Fills the space between surface and target level with unbonded discs of a new stratum.
///
/// Each disc falls at a random place, rolls down over discs and base to where two of them hold it,
/// and stays if it is not above the target. It touches without overlap, so nothing is shocked.
class Sedimentation : public Event {
public:
    Sedimentation(const SedimentationParameters& parameters, double radius_ratio,
                  double extension_rate);

    bool apply(State& state, const RigidBase& base) override;

private:
    SedimentationParameters parameters_;
    double radius_ratio_;
};

} // namespace listric
