#include "apps/archive/reservations.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <unistd.h>

namespace listric::archive {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_of_page = 200'000'000; // bytes; a report has 20 MB at most, unless asked

std::string of_makers(const std::string& makers) {
    return fmt::format("listric {} has made it, and this is {}: what a new run gives may differ",
                       makers.empty() ? "of a version that is not recorded" : makers, version);
}

/// Whether a summary is of the moment of the newest snapshot, to a cycle.
bool is_of_moment(const JsonObject& summary, double end, double newest) {
    constexpr double rounding = 0.02; // m, of a snapshot's name
    return std::abs(end - newest) <= rounding + 2.0 * cycle_of(summary);
}

/// Versions that made a run so far, by its newest snapshot; empty: it cannot be read.
std::string makers_so_far(const fs::path& newest) {
    try {
        RunRecord record = read_run_record(newest);
        record.earlier_versions.push_back(record.written_by);
        return fmt::format("{}", fmt::join(record.earlier_versions, ", "));
    } catch (const std::runtime_error&) {
        return "";
    }
}

} // namespace

std::vector<std::string> reservations(const fs::path& output, bool tells_makers) {
    const fs::path file = output / "summary.json";
    const std::vector<fs::path> snapshots = list_snapshots(output);
    const double newest = snapshots.empty() ? 0.0 : snapshot_extension(snapshots.back());
    const JsonObject summary = object_in(file);
    std::vector<std::string> said;
    std::string makers = makers_of(summary);
    std::error_code error;
    if (summary.empty()) {
        said.push_back(fs::exists(file, error)
                           ? "summary.json is damaged: listric run --resume makes it again"
                           : fmt::format("the run has not ended, it has come to {:g} m: listric "
                                         "run --resume goes on",
                                         newest));
        makers = snapshots.empty() ? "" : makers_so_far(snapshots.back());
        tells_makers = tells_makers && !makers.empty();
    }
    if (!is_of_scene(summary, read_text_if_there(output / "scene.toml")))
        said.emplace_back("summary.json is of another request than scene.toml: one of them has "
                          "been changed or copied; listric run --force makes both");
    const auto end = summary_travel(file);
    if (end && !snapshots.empty() && !is_of_moment(summary, *end, newest))
        said.push_back(fmt::format("summary.json is of {:g} m, the newest snapshot of {:g} m: "
                                   "listric run --resume makes it again",
                                   *end, newest));
    if (tells_makers && makers != version)
        said.push_back(of_makers(makers));
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
    warn_of(output, reservations(output));
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
