#pragma once

#include "dem/event.hpp"

namespace listric::dem {

/// Travel between samples of a run, m: the paper's interval of bond healing at its 1 cm a year.
inline constexpr double equilibrium_spacing = 25.0;

/// Samples how quasi-static the run is [paper: mean unbalanced against mean contact force].
///
/// Its memory has one row: samples, mean_ratio_sum, max_ratio, last_ratio, touching.
class Equilibrium : public Observer {
public:
    Equilibrium(double extension_rate, double gravity);

    bool apply(State& state, const RigidBase& base) override;

private:
    double gravity_;
};

} // namespace listric::dem
