#pragma once

#include "apps/support/machine/stop.hpp"
#include "dem/base.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/state.hpp"

#include <cstddef>

namespace listric {

/// Discs between walls that are moved by whoever tests them. The base's extension speed is 1 m/s,
/// so that Clock::extension is the time in seconds and a surface's translation its velocity in m/s.
class Specimen {
public:
    dem::State state;
    dem::RigidBase base;
    dem::CyclePhysics physics;
    dem::Cycle cycle = dem::best_cycle();
    StopToken stop;

    /// Lets a surface go on with a velocity, m/s, from where it is.
    void steer(std::size_t surface, dem::Point velocity);

    /// Gives a surface another shape and place.
    void reshape(std::size_t surface, const dem::Chain& chain, dem::Point velocity);

    /// Where the first point of a surface is now, m.
    dem::Point place_of(std::size_t surface) const;

    /// Advances on one thread; neighbour lists stay valid however the surfaces were steered.
    /// Throws Interrupted if a stop is requested.
    void advance(std::int64_t cycles);

    double time() const { return state.clock.travel.m; } ///< s

private:
    double surface_travel_ = 0.0; ///< upper bound since the surfaces were searched, m
};

} // namespace listric
