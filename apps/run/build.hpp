#pragma once

#include "apps/model/hanging_wall.hpp"
#include "apps/run/run_view.hpp"

#include <functional>

namespace listric {

// How a run's simulation is made of its scene, and extended.

/// Adds the events of the scene, whose wall time the run's record counts.
void add_events(dem::Simulation& simulation, RunView& run);

/// Says who makes the cycles: this process or all ranks, and what moves a base that deforms, with
/// the events of its loads. May be called again.
void drive(dem::Simulation& simulation, RunView& run);

/// Where a run has its hanging wall before extension from: the cache, or made anew, without files.
using HangingWallSource = dem::State(const RunView& run, const StageReport& report);
HangingWallSource kept_hanging_wall, own_hanging_wall;

/// Drives the simulation and begins it with the hanging wall before extension. Throws Interrupted.
void start(dem::Simulation& simulation, RunView& run, HangingWallSource* hanging_wall);

/// Ends a window of extension: lets the base's driver end it, calls `tell`, and remembers the
/// moment for what follows faults back.
void end_window(dem::Simulation& simulation, RunView& run, const std::function<void()>& tell);

/// Extends to `goal` and ends windows where they end. False: the report or a window's end,
/// which return whether to go on, has stopped it.
bool extend_by_windows(dem::Simulation& simulation, const RunView& run, dem::Travel goal,
                       const dem::Simulation::Report& report,
                       const std::function<bool()>& end_of_window);

} // namespace listric
