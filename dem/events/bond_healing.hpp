#pragma once

namespace listric {

/// Which relative displacement of two touching discs forbids healing.
enum class HealingMeasure { slip, slip_and_opening };

/// Intelligent crack management (ICM) [paper, "Enhanced DE models", Table 1].
struct BondHealingParameters {
    double interval = 2.5e3;      ///< time between healings, Delta t_h, a
    double strain_rate = 1.0e-15; ///< largest shear strain rate that heals, 1/s
    HealingMeasure measure = HealingMeasure::slip;
};

} // namespace listric
