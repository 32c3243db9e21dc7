#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

namespace listric::dem {

/// Whether a stage is a pause, in which base and wall rest.
inline bool rests(const MotionStage& one) { return one.slope == 0.0; }

/// Whether base and wall rest at a travel.
inline bool rests(const Motion& motion, Travel travel) {
    return !motion.stages.empty() && rests(motion.stages[motion.stage(travel)]);
}

/// Whether discs are damped towards rest: in a pause, and on the second half of the way to it on
/// which the wall slows down. Memory of faster motion would drag them on into the pause.
inline bool stops(const Motion& motion, Travel travel) {
    return rests(motion, travel) || rests(motion, travel + Travel(0.5 * Motion::change));
}

/// Whether they rest after an event, which is applied half a cycle before or behind the travel that
/// it is due at.
inline bool rests_from_now(const RigidBase& base, const Clock& clock) {
    const Travel half_cycle(0.5 * base.motion.greatest_speed() * clock.time_step);
    return rests(base.motion, clock.travel + half_cycle);
}

} // namespace listric::dem
