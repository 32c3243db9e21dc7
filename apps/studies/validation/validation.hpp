#pragma once

#include "apps/run/batch.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace listric {

/// A call of `listric validate`.
/// Its output is the document; empty: validation.md beside the runs.
struct ValidationRequest : ManyRuns {
    std::string accuracy = "standard";
    std::vector<int> seeds;          ///< that this call runs and measures; empty: those of the plan
    int number = 0;                  ///< of the plan's seeds, the first ones; 0: all
    std::filesystem::path runs;      ///< folder of the runs; empty: out/PLAN-ACCURACY
    std::string plan = "validation"; ///< a name in apps/studies, or a path
    std::vector<std::string> only;   ///< experiments; empty: all
    bool remeasure = false;          ///< even runs that are measured already
    bool without_runs = false;       ///< takes the runs that are there
    bool mixed = false;              ///< adds to a record of other definitions or parameters
};

/// Makes the runs that are not recorded, measures them from their snapshots and writes the document
/// beside a folder of the same name with pictures and measures.csv, the record: what is in it
/// stays, without its runs, and later calls add to it. Throws UsageError, SceneError,
/// StorageError, Interrupted: runs and measures are kept, the same call goes on; and what a run has
/// thrown that failed, after the others are measured and the document is written.
void run_validation(const ValidationRequest& request);

} // namespace listric
