#pragma once

#include "apps/scene/scene.hpp"
#include "apps/support/error.hpp"

#include <atomic>
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
};

enum class RunOutcome { finished, interrupted };

/// Set from a signal handler: the run saves and stops at the next opportunity.
extern std::atomic<bool> stop_requested;

/// Runs a scene from genesis or from its newest good snapshot to its end, leaving scene.toml,
/// summary.json, history.csv, snapshots, figures and log.txt in the output folder.
/// Throws UsageError, SceneError, NumericalFailure (after saying in the log which snapshot is the
/// last good one) and StorageError.
RunOutcome run_scene(const Scene& scene, const RunOptions& options);

} // namespace listric
