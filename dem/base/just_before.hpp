#pragma once

#include "dem/motion.hpp"
#include "dem/state.hpp"

namespace listric::dem {

/// Way of the run's clock in a cycle at full speed: two moments may miss each other by as much.
inline Travel travel_of_cycle(const Motion& motion, const Clock& clock) {
    return Travel(motion.greatest_speed() * clock.time_step);
}

/// A cycle before now. Of a moment that is asked for where one stage ends and the next begins the
/// stage behind it counts, on whichever side of the change its cycle has ended.
inline Travel just_before(const Motion& motion, const Clock& clock) {
    return clock.travel - travel_of_cycle(motion, clock);
}

} // namespace listric::dem
