#pragma once

#include "apps/archive/run_folder.hpp"
#include "apps/run/options.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/error.hpp"

#include <filesystem>

namespace listric {

/// Runs a scene from genesis or from its newest good snapshot to its end, leaving scene.toml,
/// summary.json, history.csv, snapshots, figures and log.txt in the output folder.
/// Throws UsageError, SceneError and, saying which snapshot is the last good one, NumericalFailure,
/// StorageError and MemoryError.
RunOutcome run_scene(const Scene& scene, const RunOptions& options);

/// Draws the figures of all snapshots of a run's folder at the scene's figure extensions and of
/// the newest one.
void draw_run(const std::filesystem::path& output);

/// Draws the same moments on one sheet, if there are at least two.
void draw_experiment(const std::filesystem::path& output);

/// Draws every snapshot of a run's folder as a frame of an animation: MP4 with ffmpeg, else GIF.
void animate_run(const std::filesystem::path& output);

} // namespace listric
