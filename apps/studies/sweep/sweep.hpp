#pragma once

#include "apps/run/batch.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace listric {

/// A part of a sweep's runs: task i of n, from 1.
struct SweepTask {
    int number = 1, of = 1;
};

/// A call of `listric sweep`.
struct SweepRequest : ManyRuns {
    bool is_lean = false; ///< runs keep what they must
    bool so_far = false;  ///< a merged table may lack runs

    std::filesystem::path plan;
    std::optional<SweepTask> task;            ///< none: all runs
    std::vector<std::filesystem::path> merge; ///< folders of tasks, to be read instead of run
};

/// Makes the runs of a plan (docs/guides/sweeps.md) and leaves sweep.csv, effects.csv, sheet.png
/// and effects.png in the output folder; a task leaves its rows of sweep.csv. Runs that are there
/// already are not made again. Returns false where all runs have failed. Throws UsageError,
/// SceneError, StorageError, Interrupted: the same call goes on from there.
bool run_sweep(const SweepRequest& request);

/// The folder of a call's results, its own if it names none.
std::filesystem::path sweep_folder(const SweepRequest& request, const SweepPlan& plan);

/// What the table of a sweep says of runs that nobody has made (emulator.py): leaves emulator.csv
/// and emulator.png beside it, and prints a plan of `suggest` points that would tell most; 0: none.
/// Throws UsageError, SceneError.
void emulate_sweep(const SweepRequest& request, int suggest);

/// Prints a call of the program for each run, with its own folder, for engines that make them; as
/// text with its price behind #, or as JSON. Throws UsageError, SceneError.
void list_sweep(const SweepRequest& request, bool as_json);

} // namespace listric
