#include "apps/run/run.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/summary.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/figures.hpp"
#include "apps/measures/fault_history.hpp"
#include "apps/run/flexure.hpp"
#include "apps/run/hints.hpp"
#include "apps/run/prediction.hpp"
#include "apps/run/session.hpp"
#include "apps/support/log.hpp"
#include "apps/support/memory.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <new>
#include <sys/file.h>
#include <unistd.h>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;

bool near_any(const std::vector<double>& marks, double extension, double tolerance) {
    return std::ranges::any_of(
        marks, [&](double mark) { return std::abs(mark - extension) <= tolerance; });
}

/// Keeps other runs out of the output folder while it lives.
class Lock {
public:
    explicit Lock(const fs::path& output)
        : file_(open((output / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
        if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(file_);
            throw UsageError(output.string() + ": another run is writing there");
        }
    }
    ~Lock() {
        if (file_ >= 0)
            close(file_);
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    int file_;
};

bool holds_run(const fs::path& output) {
    std::error_code error;
    return fs::exists(output / "scene.toml", error) || fs::exists(output / "summary.json", error);
}

/// Removes the files of a folder for which `ours` is true of the name.
template <class Ours> void remove_files(const fs::path& folder, Ours&& ours) {
    std::error_code error;
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (ours(entry.path().filename().string()))
            found.push_back(entry.path());
    for (const fs::path& path : found)
        fs::remove_all(path, error);
}

/// What a session that was killed left half done.
void remove_remains(const fs::path& output) {
    const auto half_written = [](const std::string& name) {
        // name.PID.part, as write_text and write_snapshot make them
        const std::size_t end = name.size() >= 5 && name.ends_with(".part") ? name.size() - 5 : 0;
        const std::size_t dot = end ? name.rfind('.', end - 1) : name.npos;
        return dot != name.npos && dot > 0 && end > dot + 1 &&
               std::ranges::all_of(name.substr(dot + 1, end - dot - 1),
                                   [](char c) { return c >= '0' && c <= '9'; });
    };
    for (const fs::path& folder : {output, output / "snapshots", output / "paraview"})
        remove_files(folder, half_written);
    remove_files(output / "figures", [](const std::string& name) {
        return name.starts_with(".data-") || (name.starts_with(".") && name.ends_with(".tmp"));
    });
}

/// Removes a run's own files, and nothing else that may be in the folder.
void remove_run(const fs::path& output) {
    const auto ends = [](const char* ending) {
        return [ending](const std::string& name) { return name.ends_with(ending); };
    };
    remove_files(output / "snapshots", ends(".h5"));
    remove_files(output / "paraview", ends(".vtp"));
    remove_files(output / "paraview", ends(".vtu"));
    remove_files(output / "figures", ends("km.png"));
    remove_files(output / "figures", ends("km.gif"));
    remove_files(output / "figures", ends("km.mp4"));
    std::error_code error;
    for (const char* file :
         {"summary.json", "history.csv", "paraview.pvd", "log.txt", "scene.toml", "deflection.csv",
          "base.csv", "figures/base.png", "footwall.pvd", "footwall.vtu", "figures/flexure.png"})
        fs::remove(output / file, error);
}

/// A line of a scene without its comment.
std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const char c = line[k];
        if (quote == '"' && c == '\\')
            ++k;
        else if (quote)
            quote = c == quote ? 0 : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '#') {
            line = line.substr(0, k);
            break;
        }
    }
    return line.substr(0, line.find_last_not_of(' ') + 1);
}

/// A resumed run must be the same run; comments may have changed with the program.
void check_same_scene(const Scene& scene, const fs::path& file) {
    std::ifstream in(file);
    const std::string before(std::istreambuf_iterator<char>(in), {});
    const std::string now = to_toml(scene);
    if (before.empty())
        return;
    std::string_view a = before, b = now;
    const auto next_line = [](std::string_view& text) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return without_comment(line);
    };
    std::string_view line_a, line_b;
    while (line_a == line_b && (!a.empty() || !b.empty())) {
        line_a = next_line(a);
        line_b = next_line(b);
    }
    if (line_a == line_b)
        return;
    throw UsageError(fmt::format("{}: the run to resume has other parameters: it has \"{}\", this "
                                 "call \"{}\"; resume it with "
                                 "the parameters that it began with, or start anew with --force",
                                 file.string(), line_a, line_b));
}

/// Refuses a folder that holds something else than what is asked for, before any work is done.
/// True if the run to resume has reached its end already.
bool check_output(const Scene& scene, const RunOptions& options) {
    const fs::path& output = options.output;
    const fs::path summary = output / "summary.json";
    std::error_code error;
    if (!holds_run(output) || options.force)
        return false;
    if (!options.resume)
        throw UsageError(output.string() + " holds " +
                         (fs::exists(summary, error) ? "a finished run" : "an unfinished run") +
                         ": --resume continues it, --force replaces it, --output writes elsewhere");
    check_same_scene(scene, output / "scene.toml");
    const auto reached = summary_extension(summary);
    if (scene.flexure)
        return reached.has_value();
    const double target = std::min(scene.extension.distance, options.until.value_or(1e300));
    return reached && *reached >= target - 0.5;
}

/// Makes the output folder ready for this run.
void prepare_output(const Scene& scene, const RunOptions& options) {
    const fs::path& output = options.output;
    std::error_code error;
    if (options.force && holds_run(output))
        remove_run(output);
    fs::create_directories(scene.flexure ? output : output / "snapshots", error);
    if (error)
        throw StorageError(output.string() + ": cannot make the output folder: " + error.message());
    remove_remains(output);
    write_text(output / ".write-test", "x");
    fs::remove(output / ".write-test", error);
    fs::remove(output / "summary.json", error); // of a run that now goes on
}

} // namespace

namespace {

RunOutcome run_session(const Scene& scene, const RunOptions& options, Log& log) {
    Session session(scene, options, log);
    try {
        if (!options.resume || !session.resume())
            session.begin();
        session.extend();
        session.finish();
        return RunOutcome::finished;
    } catch (const Interrupted&) {
        log.say(fmt::format("stopped at {:.2f} m of extension; {}", session.extension(),
                            resume_hint(options.output)));
        return RunOutcome::interrupted;
    }
}

/// What to do about a run that ended early, after what was wrong.
std::string with_hint(const std::exception& error, const fs::path& output, std::string_view what) {
    const bool has_snapshot = !list_snapshots(output).empty();
    return has_snapshot ? fmt::format("{}\n{}; {}, {}", error.what(), last_good_state(output), what,
                                      resume_hint(output))
                        : error.what();
}

MemoryError out_of_memory(const Scene& scene, int threads) {
    const double bytes = scene.hanging_wall ? predict(scene, 1.0, threads).memory : 0.0;
    const std::string discs =
        bytes > 0.0 ? fmt::format("the run needs about {:.0f} MB{}", std::ceil(bytes / 1e6),
                                  scene.elastic_base ? " and what its footwall takes" : "")
                    : "the elastic base takes more than there is";
    return MemoryError("memory is short: " + discs);
}

} // namespace

RunOutcome run_scene(const Scene& scene, const RunOptions& options) {
    if (check_output(scene, options))
        return RunOutcome::finished;
    const fs::path& output = options.output;
    std::error_code error;
    fs::create_directories(output, error);
    const Lock lock(output);
    prepare_output(scene, options);

    Log log(output / "log.txt", options.quiet);
    log.say(fmt::format("listric {} runs {} ({}, seed {}) into {}", version, scene.name,
                        scene.accuracy, scene.seed, output.string()));
    if (scene.hanging_wall)
        note_memory_need(predict(scene, 1.0, options.threads).memory);
    try {
        if (!scene.flexure)
            return run_session(scene, options, log);
        write_text(output / "scene.toml", to_toml(scene));
        bend_base(scene, options.threads, output, [&](const std::string& text) { log.say(text); });
        return RunOutcome::finished;
    } catch (const BeyondElasticity& limit) {
        throw NumericalFailure(
            fmt::format("{}\n{}, and valid", limit.what(), last_good_state(output)));
    } catch (const NumericalFailure& failure) {
        throw NumericalFailure(fmt::format("{}\n{}; {}", failure.what(), last_good_state(output),
                                           retry_hint(scene, output)));
    } catch (const StorageError& failure) {
        throw StorageError(with_hint(failure, output, "once files can be written"));
    } catch (const std::bad_alloc&) {
        const MemoryError failure = out_of_memory(scene, options.threads);
        throw MemoryError(with_hint(failure, output, "where there is more memory"));
    }
}

namespace {

/// A run's folder, to be drawn again.
struct Drawing : RunFolder {
    /// @param history  earlier snapshots in which the faults' history is looked up
    void add(FigureFrames& frames, const fs::path& path, std::span<const fs::path> history) const {
        const Moment moment = read(path);
        frames.add(scene, moment.state, base, moment.events,
                   report_faults(scene, base, moment.state, history));
    }

    /// Snapshots at the scene's figure extensions, and the newest.
    std::vector<fs::path> chosen() const {
        std::vector<fs::path> paths;
        for (const fs::path& path : snapshots)
            if (path == snapshots.back() || near_any(scene.output.figures, snapshot_extension(path),
                                                     0.5 * scene.output.interval))
                paths.push_back(path);
        return paths;
    }
};

/// Throws UsageError if there is nothing to draw.
Drawing open_drawing(const fs::path& output) {
    if (list_snapshots(output).empty())
        throw UsageError(output.string() + ": no snapshots to draw; is this a run's folder?");
    return Drawing{RunFolder(output)};
}

} // namespace

void draw_run(const fs::path& output) {
    std::error_code error;
    if (fs::exists(output / "deflection.csv", error)) {
        if (const std::string problem = draw_flexure(output); !problem.empty())
            throw StorageError(problem);
        return;
    }
    const Drawing drawing = open_drawing(output);
    const std::vector<fs::path> chosen = drawing.chosen();
    FigureFrames frames(output / "figures");
    for (const fs::path& path : chosen)
        drawing.add(frames, path, drawing.snapshots);
    frames.draw("sections");
    if (chosen.size() > 1)
        frames.draw("experiment");
    if (drawing.scene.elastic_base || drawing.scene.base_motion)
        draw_base(output);
}

void draw_experiment(const fs::path& output) {
    const Drawing drawing = open_drawing(output);
    const std::vector<fs::path> chosen = drawing.chosen();
    if (chosen.size() < 2)
        return;
    FigureFrames frames(output / "figures");
    for (const fs::path& path : chosen)
        drawing.add(frames, path, drawing.snapshots);
    frames.draw("experiment");
}

void animate_run(const fs::path& output) {
    const Drawing drawing = open_drawing(output);
    FigureFrames frames(output / "figures");
    for (std::size_t k = 0; k < drawing.snapshots.size(); ++k) {
        // The window before shows where the faults are; their history is not drawn.
        const std::size_t before = std::min<std::size_t>(k, 1);
        drawing.add(frames, drawing.snapshots[k],
                    std::span(drawing.snapshots).subspan(k - before, before));
    }
    frames.draw("animation");
}

} // namespace listric
