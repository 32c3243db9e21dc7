#include "apps/archive/examine.hpp"

#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/measures/evolution.hpp"
#include "apps/measures/faults/fault_history.hpp"
#include "apps/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace listric::archive {

using namespace dem;
using namespace measures;

namespace fs = std::filesystem;

FaultReport report_faults(const Setting& setting, const RigidBase& base, const State& now,
                          const RunHistory& history) {
    return measures::report_faults(setting, base, now, history.before(now.clock.travel, setting));
}

FaultReport active_faults(const Setting& setting, const RigidBase& base, const State& now,
                          const RunHistory& history) {
    return measures::report_faults(setting, base, now,
                                   history.before(now.clock.travel, setting, 1));
}

std::vector<std::pair<double, NamedNumbers>> examine_run(const fs::path& output,
                                                         std::span<const double> extensions) {
    const RunFolder run(output);
    const Setting setting = make_setting(run.scene, run.parts);
    const RigidBase& base = run.parts.base;
    const auto nearest_snapshot = [&](double extension) {
        return *std::ranges::min_element(run.snapshots, {}, [&](const fs::path& path) {
            return std::abs(snapshot_extension(path) - extension);
        });
    };
    std::map<fs::path, std::vector<double>> wanted;
    for (const double extension : extensions)
        if (const fs::path path = nearest_snapshot(extension);
            std::abs(snapshot_extension(path) - extension) <= run.scene.output.interval)
            wanted[path].push_back(extension);
    std::vector<std::pair<double, NamedNumbers>> found;
    std::vector<Past> moments;
    std::vector<Travel> times;
    for (const fs::path& path : run.snapshots) {
        const Moment moment = run.read(path);
        const State& now = moment.state;
        if (wanted.contains(path)) {
            std::vector<Past> past;
            std::vector<DiscPlaces> places;
            for (const std::size_t k : whole_windows(times, now.clock.travel, setting)) {
                past.push_back(moments[k]);
                places.push_back(moments[k].places);
            }
            const Measures measures = measure(setting, now, base, moment.events);
            const FaultReport faults = measures::report_faults(setting, base, now, places);
            NamedNumbers numbers = history_row(now, measures);
            append(numbers, measure_effects({run.scene, run.parts, now, moment.events}).numbers);
            std::erase_if(numbers, [](const auto& n) { return std::isnan(n.second); });
            append(numbers, measure_evolution(setting, base, now, faults, measures,
                                              fault_segments(moment.events), past));
            for (const double extension : wanted[path])
                found.emplace_back(extension, numbers);
        }
        moments.push_back(remember(setting, base, now, moments));
        times.push_back(now.clock.travel);
    }
    return found;
}

} // namespace listric::archive
