#include "apps/run/batch.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/run/run.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/cores.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/text.hpp"
#include "dem/cycle/cycle.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <optional>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#if defined __linux__
#include <sys/prctl.h>
#endif

namespace listric {

namespace {

namespace fs = std::filesystem;

fs::path failure_of(const BatchRun& run) { return run.options.output / "failure.json"; }

/// Earlier failure of a run.
struct Failure {
    BatchEnding ending;
    std::string scene_hash; ///< of the scene that failed
    std::string version;    ///< of the program in which it did
};

/// None if it has not failed, or a file says so that is none of ours.
std::optional<Failure> read_failure(const BatchRun& run) {
    const JsonObject file = object_in(failure_of(run));
    const auto code = number_at(file, "exit_code");
    const std::string reason = text_at(file, "reason"), scene_hash = text_at(file, "scene_hash");
    if (!code || reason.empty() || scene_hash.empty())
        return std::nullopt;
    return Failure{{static_cast<int>(std::clamp(*code, 0.0, 255.0)), reason},
                   scene_hash,
                   text_at(file, "version")};
}

std::string hash_of(const Scene& scene) {
    return fmt::format("{:016x}", archive::scene_hash(scene));
}

/// Whether numerics have failed in that: there is no use in going on with such a run.
bool is_final(const Failure& failure) {
    return failure.ending.exit_code == static_cast<int>(ExitCode::numerics_failed);
}

/// Whether the same scene would fail in the same program.
bool is_of(const Failure& failure, const Scene& scene) {
    return failure.scene_hash == hash_of(scene) && failure.version == version;
}

/// How a run ended before, if there is no use in making it again.
std::optional<BatchEnding> known_ending(const BatchRun& run) {
    const auto failure = read_failure(run);
    if (failure && is_final(*failure) && is_of(*failure, run.scene))
        return failure->ending;
    return std::nullopt;
}

/// Exit code of a process whose run is being made by another call: its folder is that call's.
constexpr int in_use = 75; // EX_TEMPFAIL of sysexits.h

/// Makes a run; leaves what went wrong in its folder. Returns the process' exit code.
int make(const BatchRun& run) {
    Ending ending{ExitCode::done, ""};
    try {
        make_folder(run.options.output);
        RunOptions options = run.options;
        // A failure with other parameters or in another version is of no use to these; a finished
        // run with others is somebody's, and refused.
        const auto failure = read_failure(run);
        options.force = failure && is_final(*failure) && !is_of(*failure, run.scene);
        options.resume = !options.force;
        std::error_code ignored;
        fs::remove(failure_of(run), ignored);
        if (run_scene(run.scene, options) == RunOutcome::interrupted)
            ending.code = ExitCode::interrupted;
    } catch (const archive::FolderInUse&) {
        return in_use;
    } catch (...) {
        ending = ending_of(std::current_exception());
    }
    const int code = static_cast<int>(ending.code);
    if (!ending.message.empty()) {
        const std::string reason = ending.message.substr(0, ending.message.find('\n'));
        try {
            write_object(failure_of(run), {{"exit_code", code},
                                           {"reason", reason},
                                           {"scene_hash", hash_of(run.scene)},
                                           {"version", version}});
        } catch (const StorageError&) {
            // the exit code says it
        }
    }
    return code;
}

/// Processes of runs. What is still under way when it ends is stopped and waited for.
class Processes {
public:
    Processes() = default;
    ~Processes() {
        stop();
        for (const auto& [process, run] : runs_)
            waitpid(process, nullptr, 0);
    }
    Processes(const Processes&) = delete;
    Processes& operator=(const Processes&) = delete;

    std::size_t count() const { return runs_.size(); }

    void begin(std::size_t number, const BatchRun& run) {
        const pid_t parent = getpid();
        std::fflush(nullptr); // or else both would write what waits
        const pid_t process = fork();
        if (process < 0)
            throw std::system_error(errno, std::generic_category());
        if (process > 0) {
            runs_[process] = number;
            return;
        }
#if defined __linux__
        prctl(PR_SET_PDEATHSIG, request_to_stop);
#endif
        _exit(getppid() == parent ? make(run) : static_cast<int>(ExitCode::interrupted));
    }

    void stop() const {
        for (const auto& [process, run] : runs_)
            kill(process, request_to_stop);
    }

    /// Calls ended(run, exit code) for those that have ended.
    template <class Ended> void reap(Ended&& ended) {
        for (auto it = runs_.begin(); it != runs_.end();) {
            int status = 0;
            const auto [process, run] = *it;
            if (waitpid(process, &status, WNOHANG) != process) {
                ++it;
                continue;
            }
            it = runs_.erase(it);
            ended(run, WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status));
        }
    }

private:
    std::map<pid_t, std::size_t> runs_;
};

BatchEnding ending_of_process(const BatchRun& run, int exit_code) {
    BatchEnding ending{exit_code};
    if (exit_code == 0)
        return ending;
    if (exit_code == in_use)
        return {static_cast<int>(ExitCode::bad_call), "another run is writing there"};
    if (exit_code == static_cast<int>(ExitCode::interrupted))
        ending.reason = "interrupted";
    else if (exit_code > 128)
        ending.reason = fmt::format("ended by signal {}", exit_code - 128);
    else if (const auto failure = read_failure(run))
        ending.reason = failure->ending.reason;
    if (ending.reason.empty())
        ending.reason = fmt::format("ended with exit code {}", exit_code);
    return ending;
}

/// Says which of the finished runs other versions have made, or begun.
void tell_of_versions(std::span<const BatchRun> runs, std::span<const BatchEnding> endings,
                      Log& log) {
    std::string names;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const std::string makers = archive::makers_of(runs[k].options.output);
        if (endings[k].reason.empty() && makers != version)
            names += fmt::format("{}{} by {}", names.empty() ? "" : ", ", runs[k].name, makers);
    }
    if (!names.empty())
        log.say(fmt::format("warning: not all runs are of this version, {}: {}; numbers may "
                            "differ; without their folders they are made again",
                            version, shown_start(names, 400)));
}

} // namespace

int ManyRuns::at_a_time() const { return jobs > 0 ? jobs : std::max(1, usable_cores() / threads); }

RunOptions ManyRuns::options_of_run(fs::path folder, bool figures) const {
    RunOptions options;
    options.output = std::move(folder);
    options.threads = threads;
    options.quiet = quiet || at_a_time() > 1;
    options.figures = figures;
    options.report = false;
    options.stop = stop;
    return options;
}

std::vector<BatchEnding> make_runs(std::span<const BatchRun> runs, const ManyRuns& call, Log& log) {
    const auto jobs = static_cast<std::size_t>(call.at_a_time());
    std::vector<BatchEnding> endings(runs.size());
    std::size_t next = 0, ended = 0;
    const auto end = [&](std::size_t k, BatchEnding ending) {
        endings[k] = std::move(ending);
        log.say(fmt::format("{} of {}: {}: {}", ++ended, runs.size(), runs[k].name,
                            endings[k].reason.empty() ? "finished" : endings[k].reason));
    };
    Processes processes;
    bool stopping = false;
    while (next < runs.size() || processes.count() > 0) {
        if (call.stop.requested() && !stopping) {
            stopping = true;
            next = runs.size();
            processes.stop();
        }
        while (next < runs.size() && processes.count() < jobs) {
            if (const auto known = known_ending(runs[next]))
                end(next, *known);
            else
                processes.begin(next, runs[next]);
            ++next;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        processes.reap(
            [&](std::size_t k, int exit_code) { end(k, ending_of_process(runs[k], exit_code)); });
    }
    call.stop.check();
    tell_of_versions(runs, endings, log);
    return endings;
}

void require_finished(const BatchRun& run, const BatchEnding& ending) {
    const std::string what = fmt::format("{}: {}", run.options.output.string(), ending.reason);
    switch (static_cast<ExitCode>(ending.exit_code)) {
    case ExitCode::done:
        return;
    case ExitCode::bad_call:
        throw UsageError(what);
    case ExitCode::numerics_failed:
        throw dem::NumericalFailure(what);
    case ExitCode::storage_failed:
        throw StorageError(what);
    case ExitCode::interrupted:
        throw Interrupted{};
    default:
        throw std::runtime_error(what);
    }
}

} // namespace listric
