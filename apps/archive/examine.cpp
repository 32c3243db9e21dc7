#include "apps/archive/examine.hpp"

#include "apps/archive/run_folder.hpp"
#include "apps/archive/setting.hpp"
#include "apps/archive/snapshot.hpp"
#include "apps/archive/summary.hpp"
#include "apps/measures/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace listric {

using namespace dem;
using namespace measures;

namespace fs = std::filesystem;

FaultReport report_faults(const Scene& scene, const RigidBase& base, const State& now,
                          std::span<const std::filesystem::path> snapshots) {
    std::vector<DiscPlaces> older;
    // The newest first, so that an extra snapshot of a stopped run cannot make a window too short.
    double next = now.clock.extension;
    const Setting setting = make_setting(scene);
    for (auto path = snapshots.rbegin(); path != snapshots.rend(); ++path) {
        try {
            const DiscPlaces places(read_snapshot(*path).state);
            if (!setting.is_window(places.extension, next))
                continue;
            next = places.extension;
            older.push_back(places);
        } catch (const StorageError&) {
            continue;
        }
    }
    std::ranges::reverse(older);
    return report_faults(setting, base, now, older);
}

std::vector<std::pair<double, NamedNumbers>> examine_run(const fs::path& output,
                                                         std::span<const double> extensions) {
    const RunFolder run(output);
    const Setting setting = make_setting(run.scene);
    const auto nearest_snapshot = [&](double extension) {
        return *std::ranges::min_element(run.snapshots, {}, [&](const fs::path& path) {
            return std::abs(snapshot_extension(path) - extension);
        });
    };
    std::map<fs::path, double> wanted;
    for (double extension : extensions)
        wanted[nearest_snapshot(extension)] = extension;
    std::vector<std::pair<double, NamedNumbers>> found;
    std::vector<Past> past;
    std::vector<DiscPlaces> places;
    for (const fs::path& path : run.snapshots) {
        const Moment moment = run.read(path);
        const State& now = moment.state;
        if (wanted.contains(path)) {
            const Measures measures = measure(setting, now, run.base, moment.events);
            const FaultReport faults = report_faults(setting, run.base, now, places);
            NamedNumbers numbers = history_row(now, measures);
            std::erase_if(numbers, [](const auto& n) { return std::isnan(n.second); });
            append(numbers, measure_evolution(setting, run.base, now, faults, measures,
                                              fault_segments(moment.events), past));
            found.emplace_back(wanted[path], std::move(numbers));
        }
        if (!past.empty() && !setting.is_window(past.back().places.extension, now.clock.extension))
            continue;
        past.push_back(remember(setting, run.base, now, past));
        places.push_back(past.back().places);
    }
    return found;
}

} // namespace listric
