#pragma once

#include "dem/event.hpp"

namespace listric::dem {

/// Time between samples of a run, a: the paper's interval of bond healing.
inline constexpr double equilibrium_interval = 2500.0;

/// Samples how quasi-static the run is [paper: mean unbalanced against mean contact force].
///
/// Its memory has one row: samples, mean_ratio_sum, max_ratio, last_ratio, touching.
class Equilibrium : public Observer {
public:
    Equilibrium(double interval, double extension_rate, double gravity);

    bool apply(State& state, const RigidBase& base) override;

private:
    double gravity_;
};

} // namespace listric::dem
