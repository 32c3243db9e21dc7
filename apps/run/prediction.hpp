#pragma once

#include "apps/run/time_left.hpp"
#include "apps/scene/scene.hpp"

#include <cstddef>

namespace listric {

/// Speed of the bare cycle on a machine, disc-steps per second when nothing else runs. Work that is
/// not shared goes at the speed of one thread: a team's cycles of few discs depend on how near the
/// cores are to each other, which no other work does.
struct CycleSpeed {
    double team = 1.0;
    double one_thread = 1.0;
    double busy = 1.0; ///< how many times longer things take now, as other programs run
};

/// Cost of a scene on a machine.
struct Prediction {
    std::size_t discs_at_start = 0, discs_at_end = 0;
    double time_step = 0.0; ///< s
    double cycles = 0.0;    ///< after genesis
    double disc_steps = 0.0;
    double work = 0.0;   ///< all that is done, disc-steps of the bare cycle
    double memory = 0.0; ///< bytes
    double snapshots = 0.0;
    double disk = 0.0;    ///< of all that is written, bytes
    double seconds = 0.0; ///< wall time, when nothing else runs
    Forecast forecast;    ///< the same by parts
};

Prediction predict(const Scene& scene, const CycleSpeed& speed = {});

/// A bonded lattice of the scene's size, at most 262,144 discs, is cycled for about `seconds` by
/// the team, and half as long by one thread, with or without the account of energy. Processor time
/// tells the speed, so that other programs do not change it.
CycleSpeed measure_speed(std::size_t discs, int threads, double seconds, bool accounted);

/// Predicted wall time of a run to an extension, m, that begins now, beside other programs.
/// @param threads  of each rank
Forecast forecast_now(const Scene& scene, double target, int threads, int ranks);

} // namespace listric
