#pragma once

#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/support/words/moment_names.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

/// All snapshots in a run's folder, oldest first.
std::vector<std::filesystem::path> list_snapshots(const std::filesystem::path& output);

/// Removes what a run has left there but its scene, summary, history, log and last snapshot, or all
/// snapshots.
void thin_out(const std::filesystem::path& output, bool all_snapshots);

/// Extension in a snapshot's name, m.
double snapshot_extension(const std::filesystem::path& snapshot);

/// The moments of a run: its snapshots at the ends of windows and the newest, oldest first. Others
/// are of moments at which the run was stopped, and has gone on since.
struct RunMoments {
    std::vector<std::filesystem::path> snapshots;
    std::vector<double> window_ends; ///< extensions that the run has come to, m
    std::string scene;               ///< that the newest holds; empty: none can be read
    dem::Table history;              ///< up to the newest
    std::vector<std::string> makers; ///< versions of the program, that of the newest last
};

/// Throws UsageError if a snapshot is of another format.
RunMoments run_moments(const std::filesystem::path& output);

/// The ends of windows that a run has come to, m, by its history.
std::vector<double> window_ends(const dem::Table& history);

/// Refuses a snapshot that another run has made than the one whose scene is given. Throws
/// UsageError.
/// @param scene  its text, or nothing: any will do
void require_same_run(const std::filesystem::path& snapshot, const std::string& holds,
                      const std::string& scene);

/// Gives the events of a scene back what they remembered. An observer that can begin at any time
/// does so if the snapshot, of an earlier version, does not know it. Throws StorageError, and then
/// no event has been changed.
/// @param path  of the snapshot, for errors
void hand_over(Snapshot& snapshot, std::span<const std::unique_ptr<dem::Event>> events,
               const std::filesystem::path& path);

/// A state and the events that remember its past.
struct Moment {
    dem::State state;
    std::vector<std::unique_ptr<dem::Event>> events;
};

/// Folder of a run: its scene and the snapshots of its moments, oldest first.
struct RunFolder {
    std::filesystem::path output;
    RunMoments moments;
    std::vector<std::filesystem::path> snapshots; ///< some of the moments'
    Scene scene;
    ModelParts parts;
    MomentNames names;

    /// Reads the scene that the run left. Throws SceneError, and StorageError if there is no
    /// snapshot.
    explicit RunFolder(const std::filesystem::path& output);

    /// The folder of a scene at hand, whose effects need not be the program's. Throws StorageError.
    RunFolder(const std::filesystem::path& output, const Scene& scene);

    /// The snapshots nearest to extensions, m, oldest first; without any, all. Throws UsageError if
    /// one is further away than the run's next snapshot would be.
    std::vector<std::filesystem::path> snapshots_at(const std::vector<double>& extensions) const;

    /// Throws StorageError, and UsageError if another run made the snapshot.
    Moment read(const std::filesystem::path& snapshot) const;
};

} // namespace listric::archive
