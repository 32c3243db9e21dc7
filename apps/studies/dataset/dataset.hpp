#pragma once

#include "apps/run/batch.hpp"

#include <filesystem>

namespace listric {

/// A call of `listric dataset`.
struct DatasetRequest : ManyRuns {
    std::filesystem::path plan;
    std::filesystem::path runs = {}; ///< folder with those of the sweep; empty: its own
    bool so_far = false;             ///< makes no run: takes those that are finished
};

/// Makes the runs of a plan that are missing (docs/guides/dataset.md), as a sweep does, and of each
/// one a section with its labels. Leaves sections, index.csv, dataset.json, the plan and a card in
/// the output folder. A section that is there and would be the same is not made again. Returns
/// false where there is no section. Throws UsageError, SceneError, StorageError, Interrupted: the
/// same call goes on from there.
bool make_dataset(const DatasetRequest& request);

} // namespace listric
