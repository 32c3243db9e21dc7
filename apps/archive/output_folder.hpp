#pragma once

#include "apps/scene/scene.hpp"

#include <filesystem>

namespace listric::archive {

/// Keeps other runs out of an output folder while it lives. Where files cannot be locked it keeps
/// nobody out.
class FolderLock {
public:
    /// The folder must exist. Throws UsageError if another run writes there.
    explicit FolderLock(const std::filesystem::path& output);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_;
};

/// Treatment of a run that is in the output folder already.
enum class ExistingRun { refused, resumed, replaced };

/// Refuses a folder that holds something else than what is asked for, or what would be lost there,
/// before any work is done.
/// True if the run to resume has reached the extension `target` (m), its end, already.
/// Throws UsageError.
bool check_output(const Scene& scene, const std::filesystem::path& output, ExistingRun existing,
                  double target);

/// Refuses a folder that holds a run, for other work whose files would replace the run's. Throws
/// UsageError.
void require_no_run(const std::filesystem::path& output);

/// Makes the output folder ready for this run: removes the run that it replaces, and what a session
/// that was killed has left half done. Throws StorageError if nothing can be written there.
void prepare_output(const Scene& scene, const std::filesystem::path& output, ExistingRun existing);

} // namespace listric::archive
