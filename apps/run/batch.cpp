#include "apps/run/batch.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/run/progress_line.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/cores.hpp"
#include "apps/support/stopwatch.hpp"
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
#include <ctime>
#include <map>
#include <numeric>
#include <optional>
#include <set>
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

/// Exit code of a process whose run is being made by another call: its folder is that call's.
constexpr int in_use = 75; // EX_TEMPFAIL of sysexits.h

/// Leaves in a run's folder why it has failed.
void record_failure(const BatchRun& run, const Ending& ending) {
    const std::string reason = ending.message.substr(0, ending.message.find('\n'));
    try {
        write_object(failure_of(run), {{"exit_code", static_cast<int>(ending.code)},
                                       {"reason", reason},
                                       {"scene_hash", hash_of(run.scene)},
                                       {"version", version}});
    } catch (const StorageError&) {
        // the exit code says it
    }
}

/// Makes a run. Returns its process' exit code.
int exit_code_of(const BatchRun& run) {
    try {
        return static_cast<int>(make_run(run) == RunOutcome::interrupted ? ExitCode::interrupted
                                                                         : ExitCode::done);
    } catch (const archive::FolderInUse&) {
        return in_use;
    } catch (...) {
        return static_cast<int>(ending_of(std::current_exception()).code);
    }
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
        _exit(getppid() == parent ? exit_code_of(run) : static_cast<int>(ExitCode::interrupted));
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

/// Says what scenes warn of, each warning with the first run that has it.
void warn_of_scenes(std::span<const BatchRun> runs, Log& log) {
    std::set<std::string> told;
    for (const BatchRun& run : runs)
        for (const std::string& warning : run.scene.warnings)
            if (told.insert(warning).second)
                log.say(fmt::format("warning: {}: {}", run.name, warning));
}

/// How far many runs are, by their predicted work.
class Tally {
public:
    explicit Tally(std::span<const BatchRun> runs) : runs_(runs) {
        for (const BatchRun& run : runs)
            work_.push_back(predict(run.scene).work);
    }

    std::size_t ended() const { return ended_; }

    void begin(std::size_t k) {
        found_ += work_[k] * share_of(k); // an earlier call has made that
        under_way_.insert(k);
    }

    void end(std::size_t k, bool failed) {
        under_way_.erase(k);
        done_ += work_[k];
        ++ended_;
        failed_ += failed ? 1 : 0;
    }

    Progress progress() const {
        double done = done_;
        for (const std::size_t k : under_way_)
            done += work_[k] * share_of(k);
        const double all = std::accumulate(work_.begin(), work_.end(), 0.0);
        const double made = done - found_; // by this call
        Progress progress{.share = done / all,
                          .what = fmt::format("{} of {} runs{}", ended_, runs_.size(),
                                              failed_ ? fmt::format(", {} failed", failed_) : ""),
                          .now = std::time(nullptr)};
        if (made > 0.005 * all)
            progress.left = seconds_since(start_) * (all - done) / made;
        return progress;
    }

private:
    /// What a run has made of its way, as its folder tells.
    double share_of(std::size_t k) const {
        const fs::path& folder = runs_[k].options.output;
        if (fs::exists(folder / "summary.json"))
            return 1.0;
        const JsonObject status = object_in(folder / "status.json");
        const auto come = number_at(status, travel_column), of = number_at(status, "of_m");
        const auto extension = number_at(status, "extension_m");
        return of && *of > 0.0 && (come || extension)
                   ? std::clamp((come ? *come : *extension) / *of, 0.0, 1.0)
                   : 0.0;
    }

    std::span<const BatchRun> runs_;
    std::vector<double> work_;
    std::set<std::size_t> under_way_;
    double done_ = 0.0, found_ = 0.0; ///< of work
    std::size_t ended_ = 0, failed_ = 0;
    SteadyClock::time_point start_ = SteadyClock::now();
};

} // namespace

std::optional<BatchEnding> known_ending(const BatchRun& run) {
    const auto failure = read_failure(run);
    if (failure && is_final(*failure) && is_of(*failure, run.scene))
        return failure->ending;
    return std::nullopt;
}

RunOutcome make_run(const BatchRun& run) {
    if (const auto known = known_ending(run))
        throw dem::NumericalFailure(fmt::format("{}\nso it ended before; without {} it is made "
                                                "again",
                                                known->reason, failure_of(run).string()));
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
        return run_scene(run.scene, options);
    } catch (const archive::FolderInUse&) {
        throw;
    } catch (...) {
        const Ending ending = ending_of(std::current_exception());
        if (!ending.message.empty())
            record_failure(run, ending);
        throw;
    }
}

int ManyRuns::at_a_time() const { return jobs > 0 ? jobs : std::max(1, usable_cores() / threads); }

RunOptions ManyRuns::options_of_run(fs::path folder, bool figures) const {
    RunOptions options;
    options.output = std::move(folder);
    options.threads = threads;
    options.quiet = true; // the call tells of it
    options.warned = true;
    options.figures = figures;
    options.report = false;
    options.stop = stop;
    return options;
}

std::vector<BatchEnding> make_runs(std::span<const BatchRun> runs, const ManyRuns& call, Log& log) {
    const auto jobs = static_cast<std::size_t>(call.at_a_time());
    std::vector<BatchEnding> endings(runs.size());
    std::size_t next = 0;
    Tally tally(runs);
    const auto end = [&](std::size_t k, BatchEnding ending) {
        endings[k] = std::move(ending);
        tally.end(k, !endings[k].reason.empty());
        log.say(fmt::format("{} of {}: {}: {}", tally.ended(), runs.size(), runs[k].name,
                            endings[k].reason.empty() ? "finished" : endings[k].reason));
    };
    warn_of_scenes(runs, log);
    Processes processes;
    bool stopping = false;
    while (next < runs.size() || processes.count() > 0) {
        if (call.stop.requested() && !stopping) {
            stopping = true;
            next = runs.size();
            processes.stop();
        }
        while (next < runs.size() && processes.count() < jobs) {
            tally.begin(next);
            if (const auto known = known_ending(runs[next]))
                end(next, *known);
            else
                processes.begin(next, runs[next]);
            ++next;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        processes.reap(
            [&](std::size_t k, int exit_code) { end(k, ending_of_process(runs[k], exit_code)); });
        log.progress([&](std::size_t columns) { return progress_line(tally.progress(), columns); });
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
