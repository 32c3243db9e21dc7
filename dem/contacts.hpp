#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

namespace listric {

/// Lists every pair of discs, and of disc and surface, closer than the skin. Shear force and bond
/// of pairs that were listed before are kept; bonded pairs are listed however far apart.
void find_contacts(State& state, const RigidBase& base);

/// True where row k of the contact table touches or is bonded.
std::vector<bool> touching(const State& state);

} // namespace listric
