#pragma once

#include "dem/base.hpp"
#include "dem/cycle/cycle_choice.hpp"
#include "dem/cycle/fast_cycle_records.hpp"

#include <cstdint>
#include <span>

namespace listric::dem::fast {

/// Velocity against which a disc's velocity is damped; with or without a sample for the mean.
enum class DampedAgainst { rest, mean_motion, mean_motion_sampled, stretching };

/// What the contacts of a packing may have. Those that resist rolling have friction.
struct ContactLaw {
    bool bonded, frictional, rolls;
};

/// Data that all strips share.
struct Shared {
    std::span<Disc> discs;
    std::span<Inertia> inertia;
    Slot* slots;
    double time_step;
    double damping;
    double mean_share;                 ///< of a sample in the mean velocity
    const std::int64_t* own = nullptr; ///< by disc: -1, or 0 for a ghost; none: there are no ghosts
};

/// The inner loops, compiled for one level.
struct Kernels {
    void (*compute_boundary)(const Shared& shared, Strip& strip);
    double (*sweep)(const Shared& shared, Strip& strip, Stretching thins);
    /// At every averaging_interval.
    double (*sampling_sweep)(const Shared& shared, Strip& strip, Stretching thins);
    /// Where base and wall come to rest, and in the pause.
    double (*resting_sweep)(const Shared& shared, Strip& strip, Stretching thins);
};

/// The cycle is compiled for contacts with and without bonds, friction and resistance to rolling,
/// and chosen when contacts are packed: bonds never form within a cycle. Ghosts of other ranks
/// count in no maximum.
Kernels choose_kernels(Cycle level, ContactLaw law, DampedAgainst motion, bool has_ghosts);

} // namespace listric::dem::fast
