#pragma once

#include "apps/support/stop.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace listric {

/// A call of `listric validate`.
struct ValidationRequest {
    std::string accuracy = "standard";
    int first_seed = 1;
    int seeds = 5;
    int jobs = 1;                    ///< runs at a time
    int threads = 1;                 ///< of a run
    std::filesystem::path runs;      ///< folder of the runs; empty: out/validation-ACCURACY
    std::filesystem::path output;    ///< document; empty: validation.md beside the runs
    std::filesystem::path plan;      ///< empty: apps/studies/validation.toml
    std::optional<std::string> only; ///< one experiment
    bool remeasure = false;          ///< even runs that are measured already
    bool without_runs = false;       ///< takes the runs that are there
    bool quiet = false;
    StopToken stop = {};
};

/// Makes the runs that are missing, measures them from their snapshots and writes the document
/// beside a folder of the same name with pictures and measures.csv. Throws UsageError, SceneError,
/// NumericalFailure, StorageError, Interrupted: runs and measures are kept, the same call goes on.
void run_validation(const ValidationRequest& request);

} // namespace listric
