#pragma once

#include "dem/base.hpp"
#include "dem/contacts/energy.hpp"
#include "dem/cycle/surroundings.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/state.hpp"

#include <cstdint>

namespace listric::dem {

/// The cycle as it is specified, a disc and a contact at a time: see advance().
/// @param total  what energies are added to, if any
/// Returns the cycles done: fewer where the neighbour lists cannot be updated.
std::int64_t advance_plainly(State& state, const RigidBase& base, const CyclePhysics& physics,
                             std::int64_t cycles, BaseResponse* response, EnergyFlows* total,
                             Surroundings& around);

} // namespace listric::dem
