#pragma once

#include "apps/run/options.hpp"
#include "apps/run/outputs.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/error.hpp"

#include <filesystem>

namespace listric {

/// Runs a scene from genesis or from its newest good snapshot to its end, leaving scene.toml,
/// summary.json, history.csv, snapshots, figures and log.txt in the output folder.
/// Throws UsageError, SceneError and, saying which snapshot is the last good one, NumericalFailure,
/// StorageError and MemoryError.
/// @param outputs  what it leaves there, and says of itself
RunOutcome run_scene(const Scene& scene, const RunOptions& options,
                     OutputList outputs = program_outputs());

} // namespace listric
