#pragma once

#include "apps/scene.hpp"

#include <cstdint>

namespace listric {

/// What a scene will cost on this machine.
struct Prediction {
    std::size_t discs_at_start = 0, discs_at_end = 0;
    double time_step = 0.0;  ///< s
    std::int64_t cycles = 0; ///< after genesis
    double disc_steps = 0.0;
    double memory = 0.0;  ///< bytes
    double seconds = 0.0; ///< wall time
};

/// @param disc_steps_per_second  of the bare cycle on this machine, from measure_rate
Prediction predict(const Scene& scene, double disc_steps_per_second);

/// Speed of the cycle on this machine, disc-steps per second: a bonded lattice of the scene's size
/// is cycled for about `seconds`, with or without the account of energy.
double measure_rate(std::size_t discs, int threads, double seconds, bool accounted);

} // namespace listric
