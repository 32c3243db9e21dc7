#pragma once

namespace listric {

/// Syn-rift sedimentation to a target level [paper, "Syn-rift sedimentation"; Table 1].
struct SedimentationParameters {
    double interval = 5.0e4;         ///< time between sedimentations, Delta t_s, a
    double level = 0.0;              ///< target level above the original surface, m
    double surface_porosity = 0.5;   ///< Phi_ini
    double grain_density = 2600.0;   ///< density at zero porosity, kg/m^3
    double friction = 0.05;          ///< mu_d of sediment discs
};

} // namespace listric
