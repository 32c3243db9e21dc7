#include "apps/archive/run_history.hpp"

#include "apps/archive/snapshot.hpp"
#include "apps/support/error.hpp"

#include <algorithm>
#include <utility>

namespace listric::archive {

using namespace measures;

RunHistory::RunHistory(std::span<const std::filesystem::path> snapshots, const std::string& scene) {
    for (const std::filesystem::path& path : snapshots) {
        try {
            const Snapshot snapshot = read_snapshot(path);
            require_same_run(path, snapshot.record.scene, scene);
            add(DiscPlaces(snapshot.state));
        } catch (const StorageError&) {
            continue;
        }
    }
}

void RunHistory::add(DiscPlaces places) {
    while (!moments_.empty() && moments_.back().extension >= places.extension)
        moments_.pop_back();
    moments_.push_back(std::move(places));
}

std::vector<DiscPlaces> RunHistory::before(double extension, const Setting& setting,
                                           std::size_t most) const {
    std::vector<DiscPlaces> found;
    double next = extension;
    for (auto moment = moments_.rbegin(); moment != moments_.rend() && found.size() < most;
         ++moment) {
        if (!setting.is_window(moment->extension, next))
            continue;
        next = moment->extension;
        found.push_back(*moment);
    }
    std::ranges::reverse(found);
    return found;
}

} // namespace listric::archive
