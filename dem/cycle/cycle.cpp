#include "dem/cycle/cycle.hpp"

#include "dem/cycle/fast_cycle.hpp"
#include "dem/cycle/plain_cycle.hpp"
#include "dem/cycle/surroundings.hpp"
#include "dem/rolling.hpp"
#include "dem/threads/shared_loop.hpp"

#include <cassert>
#include <stdexcept>
#include <string>

namespace listric::dem {

void advance(State& state, const RigidBase& base, const CyclePhysics& physics, std::int64_t cycles,
             const Execution& execution, BaseResponse* response) {
    if (!(cycles >= 0 && state.clock.time_step > 0.0))
        throw std::invalid_argument("advance: cycles are " + std::to_string(cycles) +
                                    ", at least 0, and Clock::time_step is " +
                                    std::to_string(state.clock.time_step) + " s, above 0");
    const Team team(execution.threads);
    if (add_rolling(state) && execution.packed)
        execution.packed->forget();
    Surroundings nothing;
    if (execution.energy || execution.cycle == Cycle::plain) {
        if (execution.packed)
            execution.packed->forget();
        advance_plainly(state, base, physics, cycles, response, execution.energy, nothing);
    } else {
        advance_fast(state, base, physics, cycles, execution, response, nothing);
    }
    if (cycles > 0)
        refuse_runaways(state);
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
