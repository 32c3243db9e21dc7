#include "apps/archive/folder/run_folder.hpp"

#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

namespace listric::archive {

using namespace dem;

namespace fs = std::filesystem;

std::vector<fs::path> list_snapshots(const fs::path& output) {
    if (is_file(output))
        throw UnreadableFile(fmt::format("{}: is not a directory, needs the folder of a run{}",
                                         output.string(),
                                         output.extension() == ".zip" ? "; unpack it first" : ""));
    std::vector<fs::path> snapshots;
    std::error_code error;
    const auto require_known = [&](const fs::path& path) { // else a run would begin anew
        if (error && error != std::errc::no_such_file_or_directory)
            throw UnreadableFile(path.string() + ": cannot be read: " + error.message());
    };
    const fs::directory_iterator entries(output / "snapshots", error);
    require_known(output / "snapshots");
    for (const auto& entry : entries)
        if (moment_of_snapshot(entry.path().filename().string())) {
            if (entry.is_regular_file(error))
                snapshots.push_back(entry.path());
            require_known(entry.path());
        }
    std::ranges::sort(snapshots, {}, [](const fs::path& path) {
        return std::pair(snapshot_extension(path), path.native().size());
    });
    return snapshots;
}

void thin_out(const fs::path& output, bool all_snapshots) {
    std::set<fs::path> kept;
    for (const char* name : {"scene.toml", "summary.json", "history.csv", "log.txt"})
        kept.insert(output / name);
    std::vector<fs::path> snapshots = list_snapshots(output);
    if (!all_snapshots && snapshots.size() > 1)
        snapshots.erase(snapshots.begin(), snapshots.end() - 1);
    kept.insert(snapshots.begin(), snapshots.end());
    std::error_code error;
    for (const fs::path& file : run_files(output))
        if (!kept.contains(file))
            fs::remove(file, error);
}

double snapshot_extension(const fs::path& path) {
    const auto moment = moment_of_snapshot(path.filename().string());
    return moment ? *extension_of(*moment) : 0.0;
}

std::vector<double> window_ends(const Table& history) {
    const char* clock = history.has(travel_column) ? travel_column : "extension_m";
    if (!history.has(clock))
        return {};
    const auto extensions = history.get<double>(clock);
    return {extensions.begin(), extensions.end()};
}

namespace {

/// output.interval_m of a scene's text, m.
double output_interval(const std::string& scene) {
    double interval = OutputParameters().interval;
    const auto values = scene_values(scene);
    if (const auto found = values.find("output.interval_m"); found != values.end())
        std::from_chars(found->second.data(), found->second.data() + found->second.size(),
                        interval);
    return interval;
}

} // namespace

RunMoments run_moments(const fs::path& output) {
    RunMoments moments{list_snapshots(output), {}, {}, {}, {}};
    std::vector<fs::path>& paths = moments.snapshots;
    for (std::size_t k = paths.size(); k-- > 0 && moments.scene.empty();)
        try {
            RunRecord record = read_run_record(paths[k]);
            moments.window_ends = window_ends(record.history);
            moments.scene = std::move(record.scene);
            moments.history = std::move(record.history);
            moments.makers = std::move(record.earlier_versions);
            moments.makers.push_back(std::move(record.written_by));
            const MomentNames names(output_interval(moments.scene), moments.window_ends);
            std::size_t older = 0;
            std::erase_if(paths, [&](const fs::path& path) {
                const auto moment = moment_of_snapshot(path.filename().string());
                return older++ < k && !names.window_end(*moment);
            });
        } catch (const StorageError&) {
            continue; // whoever reads it says so
        }
    return moments;
}

void require_same_run(const fs::path& snapshot, const std::string& holds,
                      const std::string& scene) {
    if (scene.empty() || scene == holds)
        return;
    const auto differs =
        scene_difference(scene_values(holds), scene_values(scene), SceneScope::results);
    if (!differs)
        return;
    const auto [there, in_rest] = shown_apart(differs->one, differs->other);
    throw UsageError(fmt::format("{}: another run has made it: {} = {} there, {} in the rest of "
                                 "the folder; take it away, or what it was copied over",
                                 snapshot.string(), shown(differs->parameter), there, in_rest));
}

namespace {

RunMoments some_moments(const fs::path& output) {
    RunMoments moments = run_moments(output);
    if (moments.snapshots.empty())
        throw StorageError(output.string() + ": no snapshots; is this a run's folder?");
    return moments;
}

/// An older version applied some events more often where the motion is slow.
void count_as_spaced_now(Event& event, Travel now) {
    const Travel spacing(event.schedule().spacing());
    if (event.schedule().calendar().pauses().empty() && std::isfinite(spacing.m) &&
        event.next_due() > now + 2.0 * spacing)
        event.applied = static_cast<std::int64_t>(now / spacing);
}

} // namespace

void hand_over(Snapshot& snapshot, std::span<const std::unique_ptr<Event>> events,
               const fs::path& path) {
    const auto is_known = [&](const Event& event) {
        return snapshot.event_memory.contains(event.name());
    };
    const auto begins_any_time = [](const Event& event) {
        const auto* observer = dynamic_cast<const Observer*>(&event);
        return observer && observer->begins_any_time();
    };
    for (const auto& event : events) // before any of them is handed its memory
        if (!is_known(*event) && !begins_any_time(*event))
            throw UsageError(fmt::format("{}: knows nothing of {}, as a program of another version "
                                         "wrote it; that version can go on with it",
                                         path.string(), event->name()));
    for (const auto& event : events) {
        if (is_known(*event)) {
            event->memory = std::move(snapshot.event_memory.at(event->name()));
            event->applied = snapshot.event_applied.at(event->name());
            count_as_spaced_now(*event, snapshot.state.clock.travel);
            continue;
        }
        while (event->next_due() <= snapshot.state.clock.travel)
            ++event->applied;
    }
}

RunFolder::RunFolder(const fs::path& folder, const Scene& of)
    : output(folder), moments(some_moments(folder)), snapshots(moments.snapshots), scene(of),
      parts(make_parts(scene)), names(scene.output.interval, moments.window_ends) {}

RunFolder::RunFolder(const fs::path& folder)
    : output(folder), moments(some_moments(folder)), snapshots(moments.snapshots) {
    const fs::path file = output / "scene.toml";
    if (const std::string text = read_text_if_there(file); !text.empty())
        require_same_run(file, text, moments.scene);
    scene = load_scene({.scene = file.string(), .is_record = true});
    parts = make_parts(scene);
    names = MomentNames(scene.output.interval, moments.window_ends);
}

std::vector<fs::path> RunFolder::snapshots_at(const std::vector<double>& extensions) const {
    if (extensions.empty())
        return snapshots;
    std::vector<fs::path> paths;
    for (const double extension : extensions) {
        const auto distance = [&](const fs::path& path) {
            return std::abs(snapshot_extension(path) - extension);
        };
        paths.push_back(*std::ranges::min_element(snapshots, {}, distance));
        const double apart = distance(paths.back()), interval = scene.output.interval;
        const double last = snapshot_extension(snapshots.back());
        const double near = 0.005 * interval; // names of older versions are those of cycles
        if (!(apart <= interval && extension <= last + near))
            throw UsageError(
                fmt::format("--at {:g}m: no snapshot there; there are some from {:g} to {:g} m",
                            extension, snapshot_extension(snapshots.front()), last));
        if (apart > near)
            warn(fmt::format("--at {:g}m: no snapshot there; the nearest is taken, at {:g} m",
                             extension, snapshot_extension(paths.back())));
    }
    std::ranges::sort(paths, {}, snapshot_extension);
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    return paths;
}

Moment RunFolder::read(const fs::path& path) const {
    Snapshot snapshot = read_snapshot(path);
    require_same_run(path, snapshot.record.scene, moments.scene);
    Moment moment{{}, make_events(scene, parts)};
    hand_over(snapshot, moment.events, path);
    moment.state = std::move(snapshot.state);
    return moment;
}

} // namespace listric::archive
