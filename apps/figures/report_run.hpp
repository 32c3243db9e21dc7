#pragma once

#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/run_history.hpp"
#include "apps/figures/frame.hpp"
#include "apps/figures/report_moments.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Request of a call of `listric report`.
struct ReportRequest {
    std::vector<std::filesystem::path> outputs; ///< folders of one or two runs
    std::filesystem::path file = {};            ///< empty: report.html in the first folder
    double most_mb = 15.0;                      ///< 1e6 bytes, that the file has at most
    bool every_line = false;                    ///< horizons and the past of faults at all moments
    std::optional<Underlay> underlay = std::nullopt;
};

/// Which snapshots of a folder are added: every n-th, those of the figures and the last. Faults are
/// followed back at these, or everywhere. None after there are more than so many bytes.
struct MomentChoice {
    int every = 1;
    bool every_line = false;
    double most_bytes = 1e300;
    bool ends_there = true; ///< the last is the run's end; else the run goes on
};

/// Adds snapshots of a folder. Returns the mean radius, m. Throws StorageError.
/// @param made  lines that have been made before, which takes longest; the others are added
double add_moments(ReportMoments& moments, const archive::RunFolder& folder,
                   const archive::RunHistory& history, LinesOfMoments& made,
                   const MomentChoice& choice = {});

/// A report that has been written, and what it lacks that the folders should have.
struct WrittenReport {
    std::filesystem::path file;
    std::vector<std::string> lacks = {};
};

/// Writes the report of finished or unfinished runs from their folders. What makes the file too
/// large is left out in this order: bonds, stress, every second snapshot and so on. Throws
/// UsageError, SceneError, StorageError.
/// @param lines  of the first run that have been made before
WrittenReport report_run(const ReportRequest& request, LinesOfMoments lines = {});

} // namespace listric
