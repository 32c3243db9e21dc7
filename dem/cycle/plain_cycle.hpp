#pragma once

#include "dem/base.hpp"
#include "dem/contacts/energy.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/state.hpp"

#include <cstdint>

namespace listric::dem {

class Links;

/// The cycle as it is specified, a disc and a contact at a time: see advance().
/// @param total  what energies are added to, if any
/// @param links  of a state that is a share; none: it is whole
/// Returns the cycles done: of a share fewer where the neighbour lists must be updated.
std::int64_t advance_plainly(State& state, const RigidBase& base, const CyclePhysics& physics,
                             std::int64_t cycles, BaseResponse* response, EnergyFlows* total,
                             Links* links = nullptr);

} // namespace listric::dem
