#include "apps/archive/output_folder.hpp"

#include "apps/archive/scene_lines.hpp"
#include "apps/archive/summary.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "apps/support/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

namespace listric::archive {

namespace fs = std::filesystem;

FolderLock::FolderLock(const fs::path& output)
    : file_(open((output / ".lock").c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666)) {
    if (file_ < 0 && (errno == EISDIR || errno == ELOOP))
        throw UsageError((output / ".lock").string() +
                         ": is a folder or a link, but keeps other runs out as a file; remove it");
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(file_);
        throw UsageError(output.string() + ": another run is writing there");
    }
}

FolderLock::~FolderLock() {
    if (file_ >= 0)
        close(file_);
}

namespace {

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
    for (const char* ending : {"km.png", "km.pdf", "km.svg", "km.gif", "km.mp4"})
        remove_files(output / "figures", ends(ending));
    for (const char* ending : {"m.csv", "m.geojson", "m.gmt", "discs.gsd"})
        remove_files(output / "export", ends(ending));
    std::error_code error;
    for (const char* file :
         {"summary.json", "history.csv", "report.html", "status.json", "paraview.pvd",
          "paraview.py", "log.txt", "scene.toml", "deflection.csv", "base.csv", "footwall.csv",
          "footwall.pvd", "footwall.vtu"})
        fs::remove(output / file, error);
    for (const std::string name : {"base", "footwall", "flexure"})
        for (const char* ending : {".png", ".pdf", ".svg"})
            fs::remove(output / "figures" / (name + ending), error);
}

/// A resumed run must be the same run; comments may have changed with the program, and whether
/// there is a report is nothing of the run.
void check_same_scene(const Scene& scene, const fs::path& file) {
    const std::string before = read_text_if_there(file);
    if (before.empty())
        return;
    const std::vector<std::string> then = scene_lines(before), now = scene_lines(to_toml(scene));
    const auto [a, b] = std::ranges::mismatch(then, now);
    if (a == then.end() && b == now.end())
        return;
    throw UsageError(fmt::format("{}: the run to resume has other parameters: it has \"{}\", this "
                                 "call \"{}\"; resume it with "
                                 "the parameters that it began with, or start anew with --force",
                                 file.string(), a == then.end() ? "" : *a,
                                 b == now.end() ? "" : *b));
}

} // namespace

bool check_output(const Scene& scene, const fs::path& output, ExistingRun existing, double target) {
    const fs::path summary = output / "summary.json";
    std::error_code error;
    if (!holds_run(output) || existing == ExistingRun::replaced)
        return false;
    if (existing == ExistingRun::refused)
        throw UsageError(output.string() + " holds " +
                         (fs::exists(summary, error) ? "a finished run" : "an unfinished run") +
                         ": --resume continues it, --force replaces it, --output writes elsewhere");
    check_same_scene(scene, output / "scene.toml");
    const auto reached = summary_extension(summary);
    if (scene.flexure)
        return reached.has_value();
    return reached && *reached >= target - 0.5;
}

void prepare_output(const Scene& scene, const fs::path& output, ExistingRun existing) {
    std::error_code error;
    if (existing == ExistingRun::replaced && holds_run(output))
        remove_run(output);
    fs::create_directories(scene.flexure ? output : output / "snapshots", error);
    if (error)
        throw StorageError(output.string() + ": cannot make the output folder: " + error.message());
    remove_remains(output);
    write_text(output / ".write-test", "x");
    fs::remove(output / ".write-test", error);
    fs::remove(output / "summary.json", error); // of a run that now goes on
}

} // namespace listric::archive
