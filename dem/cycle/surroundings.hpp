#pragma once

#include "dem/base.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Discs along the border of a state that is part of a larger one. After every cycle their places,
/// velocities and spins go to the others, and come from them.
struct Halo {
    static constexpr std::size_t numbers = 5; ///< of a disc

    std::vector<std::int32_t> sent, received; ///< rows of discs
    std::vector<double> to, from;             ///< numbers of their discs, one after the other
};

enum class ListUpdate { unchanged, changed, runaway };

/// World around the discs of a state, as a cycle sees it. Here it is empty: the state is
/// whole, and this its implementation "alone". That with others is dem/ranks/halo_exchange.hpp.
/// Called by one thread.
class Surroundings {
public:
    virtual ~Surroundings() = default;

    /// Ends a cycle: brings those discs of the state up to date that others move. Returns the
    /// largest component of a disc's velocity then, m/s.
    /// @param fastest  largest component among the discs that the cycle has moved
    virtual double after_cycle(State&, double fastest) { return fastest; }

    /// For who does that elsewhere than in the state. Null: there are no others.
    virtual Halo* halo() { return nullptr; }
    virtual void begin_exchange() {} ///< of what the halo has
    virtual void end_exchange() {}

    /// Makes numbers, none of them negative, the greatest of those that all have.
    virtual void agree_on(std::span<double>) {}

    /// Updates the neighbour lists of a state in which a disc or surface is too far from where it
    /// was found. Throws NumericalFailure if a disc has run away; with others that is for the
    /// caller to do.
    virtual ListUpdate update_lists(State& state, const RigidBase& base);

    /// Lets a base that deforms respond at the end of a cycle, if that is due.
    virtual void respond(State& state, const Clock& clock, BaseResponse* response);
};

/// Whether the base responds after the clock's cycle, every `interval` of them; 0: never.
inline bool is_response_due(int interval, const Clock& clock) {
    return interval != 0 && (clock.cycle + 1) % interval == 0;
}

} // namespace listric::dem
