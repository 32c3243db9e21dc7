#pragma once

#include "dem/event.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

/// Data that a run carries along besides the state.
struct RunRecord {
    std::string scene;  ///< the scene in force, as TOML
    dem::Table history; ///< a row per window, see docs/reference/measures.md; NaN: no meaning there
    std::map<std::string, double> seconds_by_part; ///< wall time spent so far
    double disc_steps = 0.0;                       ///< discs times cycles so far
    double predicted_seconds = 0.0;                ///< of the whole run
    std::vector<std::string> earlier_versions;     ///< of the program, before the one at work
    std::string written_by = {};                   ///< version of the program; empty: this one
};

/// Everything that the run needs to go on as if it had never stopped.
struct Snapshot {
    dem::State state;
    std::map<std::string, dem::Table> event_memory;
    std::map<std::string, std::int64_t> event_applied;
    RunRecord record;
};

/// The bytes of the HDF5 file of a snapshot. Throws StorageError.
std::vector<std::byte> snapshot_bytes(const dem::State& state,
                                      std::span<const std::unique_ptr<dem::Event>> events,
                                      const RunRecord& record);

/// Writes an HDF5 file under a temporary name and renames it, so that a file of this name is always
/// complete. Throws StorageError.
void write_snapshot(const std::filesystem::path& path, const dem::State& state,
                    std::span<const std::unique_ptr<dem::Event>> events, const RunRecord& record);

/// Throws StorageError if the file is missing, incomplete or of another kind, UsageError if it is
/// of another format: a run is then gone on with by the version that wrote it.
Snapshot read_snapshot(const std::filesystem::path& path);

/// Data that the run had carried along, without its state. Throws as read_snapshot.
RunRecord read_run_record(const std::filesystem::path& path);

/// Hash of the state and of what the events remember: equal for equal runs.
std::uint64_t run_hash(const dem::State& state,
                       std::span<const std::unique_ptr<dem::Event>> events);
std::uint64_t run_hash(const Snapshot& snapshot);

} // namespace listric::archive
