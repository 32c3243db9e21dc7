#pragma once

#include "apps/scene/scene.hpp"
#include "apps/support/error.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

/// Another call writes in an output folder.
struct FolderInUse : UsageError {
    using UsageError::UsageError;
};

/// Keeps other calls out of an output folder while it lives, by a file that it removes. Where files
/// cannot be locked it keeps nobody out.
class FolderLock {
public:
    /// The folder must exist. Throws FolderInUse, and UsageError where there is no place for it.
    explicit FolderLock(const std::filesystem::path& output);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    std::filesystem::path path_;
    int file_ = -1;
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
    bool with_report = false; ///< a finished run without one is not
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

/// Whether a folder holds the scene's finished run.
bool is_finished(const Scene& scene, const std::filesystem::path& output);

/// A file that a call writes, and a text near its beginning that only the program's own have.
struct OwnFile {
    std::filesystem::path file;
    std::string mark;
};

/// Refuses to write over files that are read, and over what somebody else has put there, for calls
/// that have no run of their own. Throws UsageError.
void require_own(std::span<const OwnFile> written, std::span<const std::filesystem::path> read);

/// Refuses a folder that holds a run, for other work whose files would replace the run's. Throws
/// UsageError.
void require_no_run(const std::filesystem::path& output);

} // namespace listric::archive
