#include "dem/cycle/cycle.hpp"

#include "dem/cycle/fast_cycle.hpp"
#include "dem/cycle/plain_cycle.hpp"
#include "dem/cycle/surroundings.hpp"
#include "dem/threads/shared_loop.hpp"

#include <cassert>

namespace listric::dem {

void advance(State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t cycles,
             const Execution& execution, BaseResponse* response) {
    assert(cycles >= 0 && execution.threads >= 1 && state.clock.time_step > 0.0);
    const Team team(execution.threads);
    Surroundings nothing;
    if (execution.energy || execution.cycle == Cycle::plain) {
        if (execution.packed)
            execution.packed->forget();
        advance_plainly(state, base, physics, cycles, response, execution.energy, nothing);
    } else {
        advance_fast(state, base, physics, cycles, execution, response, nothing);
    }
}

std::int64_t advance_part(State& part, const RigidBase& base, const CyclePhysics& physics,
                          std::int64_t cycles, const Execution& execution, BaseResponse* response,
                          Surroundings& around) {
    assert(execution.packed);
    const Team team(execution.threads);
    return execution.cycle == Cycle::plain
               ? advance_plainly(part, base, physics, cycles, response, nullptr, around)
               : advance_fast(part, base, physics, cycles, execution, response, around);
}

void unpack_part(State& part, const Execution& execution) {
    const Team team(execution.threads);
    unpack_part(part, *execution.packed);
}

} // namespace listric::dem
