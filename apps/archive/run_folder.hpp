#pragma once

#include "apps/archive/snapshot.hpp"
#include "apps/scene/effect.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace listric::archive {

/// Snapshots of a run, oldest first.
std::vector<std::filesystem::path> list_snapshots(const std::filesystem::path& output);

/// Extension in a snapshot's name, m.
double snapshot_extension(const std::filesystem::path& snapshot);

/// Gives the events of a scene back what they remembered. An observer that can begin at any time
/// does so if the snapshot, of an earlier version, does not know it. Throws StorageError.
void hand_over(Snapshot& snapshot, std::span<const std::unique_ptr<dem::Event>> events);

/// A state and the events that remember its past.
struct Moment {
    dem::State state;
    std::vector<std::unique_ptr<dem::Event>> events;
};

/// What a run left: its scene and its snapshots, oldest first.
struct RunFolder {
    std::filesystem::path output;
    Scene scene;
    ModelParts parts;
    std::vector<std::filesystem::path> snapshots;

    /// Reads the scene that the run left. Throws SceneError, and StorageError if there is no
    /// snapshot.
    explicit RunFolder(const std::filesystem::path& output);

    /// The folder of a scene at hand, whose effects need not be the program's. Throws StorageError.
    RunFolder(const std::filesystem::path& output, const Scene& scene);

    /// Throws StorageError.
    Moment read(const std::filesystem::path& snapshot) const;
};

} // namespace listric::archive
