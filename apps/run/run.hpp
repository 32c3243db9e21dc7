#pragma once

#include "apps/archive/run_folder.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/error.hpp"
#include "apps/support/stop.hpp"

#include <filesystem>
#include <optional>

namespace listric {

/// How a scene is run.
struct RunOptions {
    std::filesystem::path output;
    std::optional<double> until; ///< extension at which the run ends, m
    int threads = 1;
    bool plain = false; ///< the scalar cycle instead of the fast one, for comparison
    bool resume = false;
    bool force = false;
    bool quiet = false;
    bool figures = true; ///< drawn at the scene's extensions and at the end
    StopToken stop;      ///< requested: the run saves and ends at the next opportunity
};

enum class RunOutcome { finished, interrupted };

/// Runs a scene from genesis or from its newest good snapshot to its end, leaving scene.toml,
/// summary.json, history.csv, snapshots, figures and log.txt in the output folder.
/// Throws UsageError, SceneError, NumericalFailure (after saying in the log which snapshot is the
/// last good one) and StorageError.
RunOutcome run_scene(const Scene& scene, const RunOptions& options);

/// Draws the figures of all snapshots of a run's folder at the scene's figure extensions and of
/// the newest one.
void draw_run(const std::filesystem::path& output);

/// Draws the same moments on one sheet, if there are at least two.
void draw_experiment(const std::filesystem::path& output);

/// Draws every snapshot of a run's folder as a frame of an animation: MP4 with ffmpeg, else GIF.
void animate_run(const std::filesystem::path& output);

} // namespace listric
