#include "dem/cycle/cycle.hpp"

#include "dem/cycle/fast_cycle.hpp"
#include "dem/cycle/plain_cycle.hpp"
#include "dem/threads/shared_loop.hpp"

#include <cassert>

namespace listric::dem {

void advance(State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t cycles,
             const Execution& execution, BaseResponse* response) {
    assert(cycles >= 0 && execution.threads >= 1 && state.clock.time_step > 0.0);
    const Team team(execution.threads);
    if (execution.energy || execution.cycle == Cycle::plain) {
        if (execution.packed)
            execution.packed->forget();
        advance_plainly(state, base, physics, cycles, response, execution.energy);
    } else {
        advance_fast(state, base, physics, cycles, execution, response);
    }
}

std::int64_t advance_share(State& share, const RigidBase& base, const CyclePhysics& physics,
                           std::int64_t cycles, const Execution& execution, BaseResponse* response,
                           Links& links) {
    assert(execution.packed);
    const Team team(execution.threads);
    return execution.cycle == Cycle::plain
               ? advance_plainly(share, base, physics, cycles, response, nullptr, &links)
               : advance_fast(share, base, physics, cycles, execution, response, &links);
}

void unpack_share(State& share, const Execution& execution) {
    const Team team(execution.threads);
    unpack_share(share, *execution.packed);
}

} // namespace listric::dem
