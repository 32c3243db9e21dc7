#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace listric::dem {

// Neighbour lists. Each disc has a searched place, where the last search found it. The lists hold
// every pair of discs, and of disc and surface, whose searched places are closer than the skin; so
// no contact is missed as long as discs and surfaces are within half a skin of theirs. A disc that
// leaves gets a new searched place and only its pairs are listed anew.

/// Lists all pairs anew. Shear force and bond of pairs that were listed before are kept; bonded
/// pairs are listed however far apart.
void find_contacts(State& state, const RigidBase& base);

/// Lists the pairs of discs and surfaces anew, the surfaces where they are now: after a change of
/// their places or motion.
void find_surface_contacts(State& state, const RigidBase& base);

/// Greatest distance of a disc or surface from its searched place, m; NaN if a place is no number.
double greatest_displacement(const State& state, const RigidBase& base);

/// How far a surface is from where the last search of all surfaces found it, m, at an extension.
double surface_travel(const State& state, const RigidBase& base, double extension);

// The check of the lists. A bound of the displacements is kept from cycle to cycle. It is checked
// before cycles that are multiples of State::check_interval, so that processes that each know the
// velocities of their own discs need not tell each other in every cycle.

/// Whether a check is to measure the greatest displacement: when discs may come beyond half a skin
/// before the next check.
inline bool is_measurement_due(double displacement_bound, double skin) {
    return !(displacement_bound <= 0.42 * skin);
}

/// Cycles to the next check at most: at twice the speed of the last window, m/s, the bound grows by
/// less than what is_measurement_due leaves, and the interval by no more than twice.
inline std::int64_t next_check_interval(std::int64_t last, double speed, double time_step,
                                        double skin) {
    std::int64_t interval = std::min<std::int64_t>(2 * last, 16);
    const double per_cycle = std::numbers::sqrt2 * 2.0 * speed * time_step;
    while (interval > 1 && !(static_cast<double>(interval) * per_cycle < 0.08 * skin))
        interval /= 2;
    return interval;
}

/// Whether lists are to be updated at a measured displacement. The limit is below the limit
/// at which displacements are measured, or measurements would become frequent.
inline bool is_update_due(double displacement, double skin) {
    return !(displacement <= 0.4 * skin);
}

/// Lists the pairs of those discs and surfaces anew that are further than 0.2 skins from their
/// searched places. Returns whether a list changed.
bool update_contacts(State& state, const RigidBase& base);

/// True where row k of the contact table touches or is bonded.
std::vector<bool> touching(const State& state);

} // namespace listric::dem
