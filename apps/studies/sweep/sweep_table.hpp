#pragma once

#include "apps/studies/sweep/sweep_effects.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// A row of sweep.csv.
struct SweepRow {
    std::size_t run = 0; ///< design point, from 1
    int seed = 0;
    std::string outcome = {}; ///< "finished", or why not
    int exit_code = 0;
    std::string state_hash = {};
    std::string made_by = {};                         ///< versions of the program
    std::vector<std::optional<double>> measures = {}; ///< of the plan
    std::filesystem::path folder = {};                ///< of the run

    bool failed() const { return exit_code != 0; }
};

/// Outcome and exit code of a run that is not finished yet: it goes on by its call.
inline constexpr const char* not_yet = "not yet";

/// All runs of a plan, in folders of their own below one; seeds of a point together, since their
/// packings differ, so that runs side by side seldom wait for the same.
std::vector<SweepRow> sweep_rows(const SweepPlan& plan, std::span<const SweepPoint> points,
                                 const std::filesystem::path& folder);

/// "run 3, seed 2, material.friction=0.5"
std::string name_of_row(const SweepPlan& plan, std::span<const SweepPoint> points,
                        const SweepRow& row);

/// The scene of a row. Throws SceneError with the row and the plan's file.
Scene scene_of_row(const SweepPlan& plan, const std::filesystem::path& file,
                   std::span<const SweepPoint> points, const SweepRow& row);

/// run, seed, <parameters>, outcome, exit_code, state_hash, made_by, <measures>
std::string to_csv(const SweepPlan& plan, std::span<const SweepPoint> points,
                   std::span<const SweepRow> rows);

/// Reads what to_csv() has written. Throws UsageError if it is of another plan, SceneError,
/// StorageError.
std::vector<SweepRow> read_sweep(const SweepPlan& plan, std::span<const SweepPoint> points,
                                 const std::filesystem::path& file);

/// The parameters of rows, for effects.
std::vector<SweepFactor> factors_of(const SweepPlan& plan, std::span<const SweepPoint> points,
                                    std::span<const SweepRow> rows);

} // namespace listric
