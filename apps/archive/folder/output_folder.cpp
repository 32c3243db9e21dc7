#include "apps/archive/folder/output_folder.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <map>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace listric::archive {

namespace fs = std::filesystem;

namespace {

/// Whether an open file is still the one of that name.
bool is_at(const fs::path& path, int file) {
    struct stat there {
    }, here{};
    return stat(path.c_str(), &there) == 0 && fstat(file, &here) == 0 &&
           there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

} // namespace

FolderLock::FolderLock(const fs::path& output) : path_(output / ".lock") {
    do {
        if (file_ >= 0)
            close(file_);
        file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file_ < 0 && (errno == EISDIR || errno == ELOOP))
            throw UsageError(path_.string() + ": is a folder or a link, but keeps other runs out "
                                              "as a file; remove it");
        if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(file_);
            throw FolderInUse(output.string() +
                              ": another run is writing there; --output writes elsewhere");
        }
    } while (file_ >= 0 && !is_at(path_, file_)); // its holder has removed it meanwhile
}

FolderLock::~FolderLock() {
    if (file_ < 0)
        return;
    unlink(path_.c_str());
    close(file_);
}

namespace {

bool holds_run(const fs::path& output) {
    std::error_code error;
    return fs::exists(output / "scene.toml", error) || fs::exists(output / "summary.json", error) ||
           !list_snapshots(output).empty();
}

void remove_all(const std::vector<fs::path>& paths) {
    std::error_code error;
    for (const fs::path& path : paths)
        fs::remove_all(path, error);
}

/// A resumed run must be the same run; comments may have changed with the program, and whether
/// there is a report or a picture is nothing of the run.
/// @param text  of the scene that a file of the run's folder holds
void require_same_scene(const std::map<std::string, std::string>& now, const std::string& text,
                        const fs::path& file) {
    const auto differs = scene_difference(scene_values(text), now);
    if (!differs)
        return;
    const auto [there, here] = shown_apart(differs->one, differs->other);
    throw UsageError(fmt::format("{}: the run to resume has other parameters: {} = {} there, {} in "
                                 "this call; resume it with the parameters that it began with, "
                                 "begin again with --force, or elsewhere with --output",
                                 file.string(), shown(differs->parameter), there, here));
}

/// All that a resumed run would take for its own must be of this scene.
/// @param finished  nothing is left to do: its newest snapshot speaks for the others
void require_own_run(const FolderUse& use, const fs::path& output, bool finished) {
    const std::map<std::string, std::string> now = scene_values(use.parameters);
    const fs::path file = output / "scene.toml";
    if (const std::string before = read_text_if_there(file); !before.empty())
        require_same_scene(now, before, file);
    std::vector<fs::path> snapshots = list_snapshots(output);
    if (finished && !snapshots.empty())
        snapshots.erase(snapshots.begin(), snapshots.end() - 1);
    for (const fs::path& snapshot : snapshots) {
        std::string holds;
        try {
            holds = read_run_record(snapshot).scene;
        } catch (const StorageError&) {
            continue; // damaged: it is passed over, and said, when the run is resumed
        }
        require_same_scene(now, holds, snapshot);
    }
}

/// Files that are read must not be written over, nor removed with the run that is replaced.
void keep_what_is_read(const FolderUse& use, const fs::path& output, ExistingRun existing) {
    std::error_code error;
    for (const fs::path& file : use.files) {
        const bool is_scene = fs::equivalent(output / "scene.toml", file, error) && !error;
        if (is_scene && existing == ExistingRun::resumed && !list_snapshots(output).empty())
            continue; // they are compared
        if (is_scene && scene_lines(read_text_if_there(file)) == scene_lines(use.parameters))
            continue; // it stays as it is
        if (would_be_lost(output, file, existing == ExistingRun::replaced))
            throw UsageError(fmt::format(
                "{}: is read by this call, and a run in {} would write over it or remove it; "
                "--output writes elsewhere",
                shown(file.string()), shown(output.string())));
    }
}

/// Nor what somebody else has put there. Where a run is, files of these names are that run's,
/// damaged ones included.
void keep_what_is_there(const FolderUse& use, const fs::path& output) {
    if (!list_snapshots(output).empty())
        return;
    if (const auto file = file_in_the_way(output, use.with_base, use.with_series))
        throw UsageError(fmt::format("{}: is no file of a run, and one in {} would write over it; "
                                     "--output writes elsewhere",
                                     file->string(), output.string()));
}

/// Whether the session ended between the summary and the status, which is written last: the report
/// in between is missing, or half of it. A folder without a status tells nothing.
bool was_killed_at_the_end(const fs::path& output) {
    const std::string phase = text_at(object_in(output / "status.json"), "phase");
    return !phase.empty() && phase != "finished";
}

/// Whether the run there, of the scene that its folder has, has come to its end.
bool has_ended(const FolderUse& use, const fs::path& output) {
    const fs::path summary = output / "summary.json";
    std::error_code error;
    const auto reached = summary_travel(summary);
    return reached &&
           dem::has_come_to(dem::Travel(*reached), dem::Travel(use.end),
                            dem::Travel(cycle_of(object_in(summary)))) &&
           is_of_scene(object_in(summary), read_text_if_there(output / "scene.toml")) &&
           (!use.with_report || fs::exists(output / "report.html", error)) &&
           !was_killed_at_the_end(output);
}

/// Refuses a folder that holds something else than what is asked for, or what would be lost there,
/// before any work is done. True: the run to resume has reached its end.
bool check_output(const FolderUse& use, const fs::path& output, ExistingRun existing) {
    const fs::path summary = output / "summary.json";
    std::error_code error;
    keep_what_is_read(use, output, existing);
    if (existing == ExistingRun::refused && holds_run(output))
        throw UsageError(output.string() + " holds " +
                         (fs::exists(summary, error) ? "a finished run" : "an unfinished run") +
                         ": --resume continues it, --force replaces it, --output writes elsewhere");
    if (existing != ExistingRun::resumed || !holds_run(output)) {
        keep_what_is_there(use, output);
        return false;
    }
    const bool finished = has_ended(use, output);
    require_own_run(use, output, finished);
    return finished;
}

/// Removes the run that is replaced, and what a session that was killed has left half done.
void prepare_output(const FolderUse& use, const fs::path& output, ExistingRun existing) {
    std::error_code error;
    if (existing == ExistingRun::replaced) {
        std::vector<fs::path> files = run_files(output);
        std::erase_if(files, [&](const fs::path& file) { // the one that is read, and says the same
            return file == output / "scene.toml" &&
                   scene_lines(read_text_if_there(file)) == scene_lines(use.parameters);
        });
        remove_all(files);
    }
    fs::create_directories(use.with_snapshots ? output / "snapshots" : output, error);
    if (error)
        throw StorageError(output.string() + ": cannot make the output folder: " + error.message());
    remove_all(remains(output));
    const fs::path test = output / write_test;
    listric::write_text(test, "x");
    fs::remove(test, error);
    fs::remove(output / "summary.json", error); // of a run that now goes on
}

} // namespace

FolderUse folder_use(const Scene& scene, double target) {
    const double interval = scene.output.interval;
    const double near =
        std::clamp(1e-3 * scene.hanging_wall.mean_radius, 0.005 * interval, 0.5 * interval);
    return {to_toml(scene), scene.files, target - near, make_parts(scene).base_moves,
            scene.output.series == SeriesFormat::paraview};
}

bool is_finished(const Scene& scene, const fs::path& output) {
    const FolderUse use = folder_use(scene, scene.extension.distance);
    return has_ended(use, output) &&
           !scene_difference(scene_values(use.parameters),
                             scene_values(read_text_if_there(output / "scene.toml")));
}

std::unique_ptr<FolderLock> take_output(const FolderUse& use, const fs::path& output,
                                        ExistingRun existing) {
    if (check_output(use, output, existing))
        return nullptr;
    std::error_code error;
    fs::create_directories(output, error);
    auto lock = std::make_unique<FolderLock>(output);
    prepare_output(use, output, existing);
    return lock;
}

void require_own(std::span<const OwnFile> written, std::span<const fs::path> read) {
    constexpr std::size_t beginning = 1 << 16;
    for (const auto& [file, mark] : written) {
        std::error_code error;
        if (!fs::is_regular_file(file, error))
            continue;
        const bool is_read = std::ranges::any_of(read, [&, &file = file](const fs::path& other) {
            return fs::equivalent(file, other, error) && !error;
        });
        if (is_read || !holds(file, mark, beginning))
            throw UsageError(fmt::format(
                "{}: {} would be written over; move it, or --output writes "
                "elsewhere",
                shown(file.string()),
                is_read ? "is read by this call, and" : "is no file of such a call, and"));
    }
}

void require_no_run(const fs::path& output) {
    if (!list_snapshots(output).empty())
        throw UsageError(output.string() + " holds a run, whose summary.json would be replaced; "
                                           "--output writes elsewhere");
}

} // namespace listric::archive
