#include "apps/archive/folder/run_history.hpp"

#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/support/error.hpp"

#include <algorithm>
#include <utility>

namespace listric::archive {

using namespace dem;
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
    while (!moments_.empty() && moments_.back().travel >= places.travel)
        moments_.pop_back();
    moments_.push_back(std::move(places));
}

std::vector<std::size_t> whole_windows(std::span<const Travel> moments, Travel now,
                                       const Setting& setting, std::size_t most) {
    std::vector<std::size_t> found;
    Travel next = now;
    for (std::size_t k = moments.size(); k-- > 0 && found.size() < most;)
        if (moments[k] < next && setting.is_window(moments[k], next)) {
            next = moments[k];
            found.push_back(k);
        }
    // A rest at the start, in a stage that is slower than the others, goes to the first window.
    if (found.size() < most && !moments.empty() && moments.front() < next) {
        if (!found.empty())
            found.back() = 0;
        else if (setting.motion.way(moments.front(), now).m > 0.0)
            found.push_back(0);
    }
    std::ranges::reverse(found);
    return found;
}

std::vector<DiscPlaces> RunHistory::before(Travel now, const Setting& setting,
                                           std::size_t most) const {
    std::vector<Travel> moments;
    for (const DiscPlaces& places : moments_)
        moments.push_back(places.travel);
    std::vector<DiscPlaces> found;
    for (const std::size_t k : whole_windows(moments, now, setting, most))
        if (setting.is_window(moments[k], now))
            found.push_back(moments_[k]);
    return found;
}

} // namespace listric::archive
