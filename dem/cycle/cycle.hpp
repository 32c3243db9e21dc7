#pragma once

#include "dem/base.hpp"
#include "dem/cycle/execution.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/state.hpp"

#include <cstdint>

namespace listric::dem {

/// Advances by `cycles` cycles, searching neighbours whenever discs may have come closer than the
/// list knows. One cycle: contact forces from positions and the velocities half a step earlier;
/// then each disc's motion. Forces on a disc are added in the order base contacts, then contacts
/// by row. Nodes of a base that deforms collect the loads by row of the base contacts, then
/// `response` sets their velocities; without one they keep them. Throws NumericalFailure if a disc
/// runs away; no disc is without a place when it returns.
void advance(State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t cycles,
             const Execution& execution = {}, BaseResponse* response = nullptr);

class Surroundings;

/// Advances a part of a packing as dem::advance() does a whole one. Those who have the other parts
/// call it alike. Only the clock is up to date then: unpack_part() brings the rest.
/// @param execution  with what is packed, kept until then
/// @param response   null but on the root
/// Returns the cycles done, of all parts as many: fewer where a disc has run away.
std::int64_t advance_part(State& part, const RigidBase& base, const CyclePhysics& physics,
                          std::int64_t cycles, const Execution& execution, BaseResponse* response,
                          Surroundings& around);
void unpack_part(State& part, const Execution& execution);

} // namespace listric::dem
