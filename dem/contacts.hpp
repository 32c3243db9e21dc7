#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <cstdint>
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

/// Whether the greatest displacement is to be measured before a cycle: when discs may be beyond
/// half a skin, and every 1000 cycles, since NaN hides from the bound.
inline bool is_check_due(double displacement_bound, double skin, std::int64_t cycle) {
    return displacement_bound > 0.5 * skin || cycle % 1000 == 0;
}

/// Whether lists are to be updated at a measured displacement. The limit is below that of a check,
/// or checks would become frequent.
inline bool is_update_due(double displacement, double skin) {
    return !(displacement <= 0.4 * skin);
}

/// Lists the pairs of those discs and surfaces anew that are further than 0.2 skins from their
/// searched places. Returns whether a list changed.
bool update_contacts(State& state, const RigidBase& base);

/// True where row k of the contact table touches or is bonded.
std::vector<bool> touching(const State& state);

} // namespace listric::dem
