#pragma once


#include <vector>

namespace listric {

/// Automatic fault detection (AFD) [paper, Fig. 4c, d; Table 1].
struct FaultWeakeningParameters {
    double interval = 5.0e4;           ///< time between scans, Delta t_w, a
    double strain_rate = 1.0e-13;      ///< least shear strain rate of a fault, 1/s
    double circle_diameters = 5.0;     ///< measure circle's diameter, mean disc diameters
    double strained_width = 0.6;       ///< width that the strain rate refers to, circle diameters
    double spacing_diameters = 5.0;    ///< least distance to a more active fault, mean diameters
    double band_diameters = 3.0;       ///< width of the weakened band, mean diameters
    int angles = 12;                   ///< fault angles tried per sampling point
    double youngest_sediment = 2.0e5;  ///< sediment younger than this is left alone, a
    double stiffness_divisor = 200.0;  ///< stiffness of sound over weakened discs
    double friction = 0.0;             ///< friction of weakened discs
    double update_interval = 2.5e3;    ///< time between property updates, a
    double mean_stress_ratio = 0.75;   ///< mean stress in a fault over lithostatic stress
    double largest_change = 0.05;      ///< largest relative radius change per property update
};

} // namespace listric
