#pragma once

#include "dem/event.hpp"

namespace listric::dem {

/// Which relative displacement of two touching discs forbids healing: the paper's criterion is a
/// shear strain rate, and opening counts the squeezing of a compacting sediment as well.
enum class HealingMeasure { slip, slip_and_opening };

/// Intelligent crack management (ICM) [paper, "Enhanced DE models", Table 1].
struct BondHealingParameters {
    double interval = 2.5e3;      ///< time between healings, Delta t_h, a
    double strain_rate = 1.0e-15; ///< largest shear strain rate that heals, 1/s
    HealingMeasure measure = HealingMeasure::slip;
};

/// Bonds touching pairs whose discs hardly moved against each other since the last healing.
class BondHealing : public Event {
public:
    BondHealing(const BondHealingParameters& parameters, const BondStrength& strength,
                const Calendar& calendar);

    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;

private:
    BondHealingParameters parameters_;
    BondStrength strength_;
};

} // namespace listric::dem
