#pragma once

#include "dem/base.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/energy.hpp"
#include "dem/state.hpp"

#include <cstdint>

namespace listric::dem {

/// The cycle as it is specified, a disc and a contact at a time: see advance().
/// @param total  what energies are added to, if any
void advance_plainly(State& state, const RigidBase& base, const CyclePhysics& physics,
                     std::int64_t cycles, BaseResponse* response, EnergyFlows* total);

} // namespace listric::dem
