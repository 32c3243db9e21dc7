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
/// runs away.
void advance(State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t cycles,
             const Execution& execution = {}, BaseResponse* response = nullptr);

class Links;

/// The same of a share. All ranks call it alike. Only the clock is up to date then: unpack_share()
/// brings the rest.
/// @param execution  with what is packed, kept until then
/// @param response   null but on the root
/// Returns the cycles done, on all ranks the same: fewer where a disc has run away.
std::int64_t advance_share(State& share, const RigidBase& base, const CyclePhysics& physics,
                           std::int64_t cycles, const Execution& execution, BaseResponse* response,
                           Links& links);
void unpack_share(State& share, const Execution& execution);

} // namespace listric::dem
