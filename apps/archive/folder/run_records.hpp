#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace listric::archive {

/// A measure whose error is told wherever a run's results are.
struct HeadlineMeasure {
    std::string key;       ///< in summary.json; its label is for people
    std::string_view word; ///< in `--error`: cutoff stands for both of its numbers
};

/// The twelve of them, in the order in which they are shown.
std::span<const HeadlineMeasure> headline_measures();

/// What a run's cycles go with besides its resolution.
struct Pace {
    double speed = 0.0; ///< of extension, m/s
    double ramp = 24.0; ///< time in which the speed grew from rest, s
    double softness = 1.0;
};

/// A run that a study has recorded, at one extension.
struct RecordedRun {
    std::string record;       ///< page or study that it comes from
    std::string scene;        ///< name of a shipped scene, unchanged but for what follows
    std::string made_by;      ///< version and commit
    double mean_radius = 0.0; ///< m
    Pace pace;
    double extension = 0.0; ///< m
    int seed = 0;
    std::map<std::string, double> measures; ///< those headline measures that are known
};

/// Runs in a file: CSV with the columns record, scene, made_by, mean_radius_m, speed_m_per_s,
/// ramp_s, softness, extension_m, seed and the headline measures, in any order; an empty field is
/// unknown. Throws StorageError.
std::vector<RecordedRun> read_run_records(const std::filesystem::path& file);

/// Throws StorageError.
void write_run_records(const std::filesystem::path& file, std::span<const RecordedRun> runs);

/// All that the program knows: the CSV files in record_folder(), by their names. Throws
/// StorageError for a file that is damaged.
std::vector<RecordedRun> recorded_runs();

} // namespace listric::archive
