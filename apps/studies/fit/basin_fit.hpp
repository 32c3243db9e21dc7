#pragma once

#include "apps/run/batch.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace listric {

/// A call of `listric fit`.
struct BasinFitRequest : ManyRuns {
    std::filesystem::path picks;       ///< CSV: name, x_m, depth_m, age_a
    std::string scene = "lis1";        ///< of which all but the detachment is kept
    std::vector<std::string> set = {}; ///< changes of it
    std::string accuracy = "draft";    ///< of the runs
    bool predict_only = false;         ///< no run is made
    int seeds = 3;                     ///< of the best shape
    int first_seed = 1;
    int rounds = 2; ///< of drafts, at most
};

/// Fits a listric detachment to picked horizons (docs/guides/fit.md): kinematics first, then drafts
/// about what they find. Leaves fit.json, profile.csv, with runs fit.csv, and the scene PICKS.toml
/// in the output folder, and prints the answer. Runs that are there already are not made again.
/// Returns false where too many runs have failed. Throws UsageError, SceneError, StorageError,
/// Interrupted: the same call goes on from there.
bool run_basin_fit(const BasinFitRequest& request);

} // namespace listric
