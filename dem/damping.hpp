#pragma once

#include <cmath>

namespace listric::dem {

/// The force less local damping: a share of its size that opposes the velocity, so that steady
/// motion is free [Itasca 1999, as cited by the paper]. What is at rest is not damped. A force in N
/// with a velocity in m/s, or a moment in N m with a spin in 1/s; `damping` is the share.
inline double damped(double force, double velocity, double damping) {
    return velocity == 0.0 ? force : force - std::copysign(damping * std::abs(force), velocity);
}

} // namespace listric::dem
