#pragma once

#include "apps/run/options.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/words/log.hpp"

#include <span>
#include <string>
#include <vector>

namespace listric {

/// How a call makes many runs.
struct ManyRuns {
    std::filesystem::path output; ///< folder of its results; empty: the call's own
    int jobs = 1;                 ///< runs at a time; 0: cores over threads
    int threads = 1;              ///< of a run
    bool quiet = false;
    StopToken stop = {};

    int at_a_time() const;

    /// Options of one of the runs, which writes no report.
    RunOptions options_of_run(std::filesystem::path folder, bool figures = false) const;
};

/// A run among many.
struct BatchRun {
    std::string name; ///< for people
    Scene scene;
    RunOptions options; ///< it goes on with what is in its folder
};

/// How it ended.
struct BatchEnding {
    int exit_code = 0;       ///< ExitCode's, or 128 and the signal that ended it
    std::string reason = {}; ///< first line of its error; empty if it is finished
};

/// Makes one of many runs in this process. Where numerics fail it leaves failure.json, and while
/// that is there of the same scene and program it throws this failure again at once. Throws what
/// run_scene() throws.
RunOutcome make_run(const BatchRun& run);

/// How numerics have ended a run before, if there is no use in making it again; none: it may be
/// made, or is finished.
std::optional<BatchEnding> known_ending(const BatchRun& run);

/// Makes runs, each in a process of its own, so many at a time, so that what ends one does not end
/// the others. What is finished is not made again; nor is what numerics have failed in, which
/// failure.json in its folder says of the same scene: without that file, or of another scene, it
/// is. Throws Interrupted, once the runs under way have saved, and StorageError. The same call goes
/// on from there; if this process is killed the runs save and stop, too (Linux).
std::vector<BatchEnding> make_runs(std::span<const BatchRun> runs, const ManyRuns& call, Log& log);

/// Throws what the run has thrown, if it is not finished.
void require_finished(const BatchRun& run, const BatchEnding& ending);

} // namespace listric
