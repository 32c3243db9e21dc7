#pragma once

#include "apps/run/run_view.hpp"

namespace listric {

// How a run's simulation is made of its scene.

/// Adds the events of the scene, whose wall time the run's record counts.
void add_events(dem::Simulation& simulation, RunView& run);

/// Says who makes the cycles: this process or all ranks, and what moves a base that deforms, with
/// the events of its loads. May be called again.
void drive(dem::Simulation& simulation, RunView& run);

/// Drives the simulation and begins it with the hanging wall before extension. Throws Interrupted.
void start(dem::Simulation& simulation, RunView& run);

} // namespace listric
