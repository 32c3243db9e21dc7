#pragma once

#include "apps/run/forecast/time_left.hpp"
#include "apps/run/options.hpp"
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
    double work = 0.0;        ///< all that is done, disc-steps of the bare cycle
    double shared_work = 0.0; ///< of that, what threads share
    double memory = 0.0;      ///< bytes
    double snapshots = 0.0;
    double disk = 0.0;    ///< of all that is written, bytes
    double seconds = 0.0; ///< wall time, when nothing else runs
    Forecast forecast;    ///< the same by parts
};

Prediction predict(const Scene& scene, const CycleSpeed& speed = {});

/// Prices of a run's parts besides effects, disc-steps of the bare cycle, so that they follow the
/// machine's speed. Measured on lis1, lis2 and rfr at draft and lis1 at standard; genesis and
/// lists of many discs on lis1 up to sandbox (docs/record/2026-11/sandbox.md).
struct RunPrices {
    /// Contacts of a moving packing are less regular than those of the lattice, and are listed anew
    /// more often.
    double cycle = 1.05;
    double lists_shared_from = 10000.0; ///< discs; one thread makes the lists of fewer
    double lists_far_from = 200000.0;   ///< discs; the lists of as many are in no cache
    double list_alone = 0.15, list_shared = 0.07, list_far = 0.31;
    /// A disc of the hanging wall that is made. Settling takes as many cycles as waves need to
    /// cross it: so many more per radius of its thickness.
    double genesis = 6000.0, genesis_crossing = 245.0;
    double window = 1e6, window_disc = 1300.0; ///< history and a snapshot
    double sample_spacing = 25.0;              ///< of how quasi-static the run is, m of travel
    double sample_disc = 30.0;
    /// The last pictures and the sheet with all moments; earlier ones are drawn beside the cycle,
    /// and only their arrays take time.
    double early_figure_disc = 1000.0, figures = 2.2e8, figures_disc = 3000.0;
    double figures_of_moving_base = 1.0e8;
    double figure_beside = 9e7; ///< of an earlier one, where no core is free for it
};
inline constexpr RunPrices run_prices{};

/// Memory in which a report keeps the moments of a run that goes on, bytes. Of more it is made
/// anew at the end, from the snapshots.
inline constexpr double most_of_report = 2e8;

/// A bonded lattice of the scene's size, at most 262,144 discs, is cycled for about `seconds` by
/// the team, and half as long by one thread, with or without the account of energy. Processor time
/// tells the speed, so that other programs do not change it.
CycleSpeed measure_speed(std::size_t discs, int threads, double seconds, bool accounted);

/// Predicted wall time of a run to an extension, m, that begins now, beside other programs.
/// @param options  how it is run: threads of each rank, and whether figures are drawn
Forecast forecast_now(const Scene& scene, double target, const RunOptions& options, int ranks);

} // namespace listric
