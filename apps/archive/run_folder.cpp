#include "apps/archive/run_folder.hpp"

#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace listric::archive {

using namespace dem;

namespace fs = std::filesystem;

std::vector<fs::path> list_snapshots(const fs::path& output) {
    std::vector<fs::path> snapshots;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(output / "snapshots", error))
        if (entry.path().extension() == ".h5")
            snapshots.push_back(entry.path());
    // By extension: longer names are further.
    std::ranges::sort(snapshots, {},
                      [](const fs::path& p) { return std::pair(p.native().size(), p.native()); });
    return snapshots;
}

double snapshot_extension(const fs::path& path) {
    return std::strtod(path.filename().c_str() + std::strlen("extension-"), nullptr);
}

namespace {

std::vector<fs::path> some_snapshots(const fs::path& output) {
    std::vector<fs::path> snapshots = list_snapshots(output);
    if (snapshots.empty())
        throw StorageError(output.string() + ": no snapshots; is this a run's folder?");
    return snapshots;
}

} // namespace

void hand_over(Snapshot& snapshot, std::span<const std::unique_ptr<Event>> events) {
    for (const auto& event : events) {
        const auto memory = snapshot.event_memory.find(event->name());
        const bool is_known = memory != snapshot.event_memory.end();
        const auto* observer = dynamic_cast<const Observer*>(event.get());
        if (!is_known && observer && observer->begins_any_time()) {
            while (event->next_due() <= snapshot.state.clock.extension)
                ++event->applied;
            continue;
        }
        if (!is_known)
            throw StorageError("the snapshot knows nothing of " + event->name());
        event->memory = std::move(memory->second);
        event->applied = snapshot.event_applied.at(event->name());
    }
}

RunFolder::RunFolder(const fs::path& folder, const Scene& of)
    : output(folder), scene(of), parts(make_parts(scene)), snapshots(some_snapshots(folder)) {}

RunFolder::RunFolder(const fs::path& folder) : output(folder), snapshots(some_snapshots(folder)) {
    scene = load_scene({.scene = (output / "scene.toml").string(), .is_record = true});
    parts = make_parts(scene);
}

Moment RunFolder::read(const fs::path& path) const {
    Snapshot snapshot = read_snapshot(path);
    Moment moment{{}, make_events(scene, parts)};
    hand_over(snapshot, moment.events);
    moment.state = std::move(snapshot.state);
    return moment;
}

} // namespace listric::archive
