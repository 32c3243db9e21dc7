#include "apps/archive/reservations.hpp"

#include "apps/archive/provenance.hpp"
#include "apps/archive/run_files.hpp"
#include "apps/archive/summary.hpp"
#include "apps/support/error.hpp"
#include "apps/support/file.hpp"
#include "apps/support/log.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <unistd.h>

namespace listric::archive {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_of_page = 200'000'000; // bytes; a report has 20 MB at most, unless asked

void add_makers(std::vector<std::string>& said, const std::string& makers) {
    if (makers != version)
        said.push_back(fmt::format("listric {} has made it, and this is {}: what a new run gives "
                                   "may differ",
                                   makers.empty() ? "of a version that is not recorded" : makers,
                                   version));
}

} // namespace

std::vector<std::string> reservations(const JsonObject& summary, const std::string& scene) {
    std::vector<std::string> said;
    add_makers(said, makers_of(summary));
    if (!is_of_scene(summary, scene))
        said.emplace_back("summary.json is of another request than scene.toml: one of them has "
                          "been changed or copied; listric run --force makes both");
    return said;
}

std::vector<std::string> reservations(const RunFolder& run) {
    const fs::path file = run.output / "summary.json";
    const JsonObject summary = object_in(file);
    const double last = snapshot_extension(run.moments.snapshots.back());
    if (!summary.empty()) {
        auto said = reservations(summary, read_text_if_there(run.output / "scene.toml"));
        const auto end = summary_travel(file);
        if (end && std::abs(*end - last) > 0.01 * run.scene.output.interval)
            said.push_back(fmt::format("summary.json is of {:g} m, the newest snapshot of {:g} m: "
                                       "listric run --resume makes it again",
                                       *end, last));
        return said;
    }
    std::vector<std::string> said;
    std::error_code error;
    said.push_back(fs::exists(file, error)
                       ? "summary.json is damaged: listric run --resume makes it again"
                       : fmt::format("the run has not ended, it has come to {:g} m: listric run "
                                     "--resume goes on",
                                     last));
    if (!run.moments.makers.empty())
        add_makers(said, fmt::format("{}", fmt::join(run.moments.makers, ", ")));
    return said;
}

void warn_of(const fs::path& output, const std::vector<std::string>& reservations) {
    for (const std::string& one : reservations)
        warn(fmt::format("{}: {}", output.string(), one));
}

void make_result_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!error && access(folder.c_str(), W_OK) != 0)
        error.assign(errno, std::generic_category());
    if (error)
        throw StorageError(fmt::format("{}: cannot be written: {}; --output writes elsewhere",
                                       folder.string(), error.message()));
}

RunFolder shown_run(const fs::path& output) {
    RunFolder run(output);
    warn_of(output, reservations(run));
    return run;
}

bool is_up_to_date(const fs::path& page, const fs::path& output) {
    constexpr std::chrono::seconds together(10); // files of one moment, as they are written
    std::error_code error;
    const auto made = fs::last_write_time(page, error);
    if (error)
        return false;
    const fs::path summary = output / "summary.json";
    if (const auto ended = fs::last_write_time(summary, error); !error) {
        const std::string state = text_at(object_in(summary), "state_hash");
        return made >= ended && !state.empty() && holds(page, state, most_of_page);
    }
    const std::vector<fs::path> snapshots = list_snapshots(output);
    return !snapshots.empty() && made + together >= fs::last_write_time(snapshots.back(), error) &&
           !error;
}

} // namespace listric::archive
