#pragma once

#include "dem/base.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/execution.hpp"
#include "dem/state.hpp"

#include <cstdint>

namespace listric::dem {

/// Advances by `cycles` cycles, searching neighbours whenever discs may have come closer than the
/// list knows. One cycle: contact forces from positions and the velocities half a step earlier;
/// then each disc's motion. Forces on a disc are added in the order base contacts, then contacts
/// by row. Nodes of a base that deforms collect the loads by row of the base contacts, then
/// `response` sets their velocities; without one they keep them. Throws NumericalFailure if a disc
/// runs away.
void advance(State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t cycles,
             const Execution& execution = {}, BaseResponse* response = nullptr);

} // namespace listric::dem
