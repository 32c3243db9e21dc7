#pragma once

#include "apps/scene/scene.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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

/// A run's claims on the folder of its results.
struct FolderUse {
    std::string parameters;                    ///< all in force, the text of scene.toml
    std::vector<std::filesystem::path> files;  ///< that were read for it; none of them may be lost
    double end = 0.0;                          ///< extension from which on it is finished, m
    bool with_base = true, with_series = true; ///< writes files of these
    bool with_snapshots = true;
};

/// The claims of a scene's run to the extension `target`, m.
FolderUse folder_use(const Scene& scene, double target);

/// Makes the output folder ready for a run, and keeps others out. Before any work it refuses a
/// folder that holds something else than what is asked for, or what would be lost there; then it
/// removes the run that is replaced, and what a session that was killed has left half done. Null:
/// the run to resume has reached its end. Throws UsageError, and StorageError if nothing can be
/// written there.
std::unique_ptr<FolderLock> take_output(const FolderUse& use, const std::filesystem::path& output,
                                        ExistingRun existing);

/// Refuses a folder that holds a run, for other work whose files would replace the run's. Throws
/// UsageError.
void require_no_run(const std::filesystem::path& output);

} // namespace listric::archive
