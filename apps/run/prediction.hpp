#pragma once

#include "apps/scene/scene.hpp"

#include <cstddef>

namespace listric {

/// Speed of the cycle on this machine.
struct CycleSpeed {
    double disc_steps_per_second = 0.0; ///< of all threads, when nothing else runs
    double busy = 1.0; ///< how many times longer things take now, as other programs run
};

/// What a scene will cost on this machine.
struct Prediction {
    std::size_t discs_at_start = 0, discs_at_end = 0;
    double time_step = 0.0; ///< s
    double cycles = 0.0;    ///< after genesis
    double disc_steps = 0.0;
    double work = 0.0;    ///< all that is done, disc-steps of the bare cycle
    double memory = 0.0;  ///< bytes
    double seconds = 0.0; ///< wall time, when nothing else runs
};

/// @param disc_steps_per_second  of the bare cycle on this machine
Prediction predict(const Scene& scene, double disc_steps_per_second, int threads);

/// A bonded lattice of the scene's size is cycled for about `seconds`, with or without the account
/// of energy. Processor time tells the speed, so that other programs do not change it.
CycleSpeed measure_speed(std::size_t discs, int threads, double seconds, bool accounted);

} // namespace listric
