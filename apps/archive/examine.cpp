#include "apps/archive/examine.hpp"

#include "apps/archive/run_folder.hpp"
#include "apps/archive/snapshot.hpp"
#include "apps/archive/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace listric::archive {

using namespace dem;

namespace fs = std::filesystem;

namespace {

/// Shorter than a window of the run, and longer than the rest that a stopped run leaves.
double least_window(const Scene& scene) { return 0.75 * scene.output.interval; }

} // namespace

FaultReport report_faults(const Scene& scene, const RigidBase& base, const State& now,
                          const RunHistory& history) {
    return listric::report_faults(scene, base, now,
                                  history.before(now.clock.extension, least_window(scene)));
}

std::vector<std::pair<double, NamedNumbers>> examine_run(const fs::path& output,
                                                         std::span<const double> extensions) {
    const RunFolder run(output);
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
            const Measures measures = measure(run.scene, now, run.parts.base, moment.events);
            const FaultReport faults = listric::report_faults(run.scene, run.parts.base, now, places);
            NamedNumbers numbers = history_row(now, measures);
            std::erase_if(numbers, [](const auto& n) { return std::isnan(n.second); });
            const NamedNumbers more =
                measure_structure(run.scene, run.parts.base, now, moment.events, faults, measures, past);
            numbers.insert(numbers.end(), more.begin(), more.end());
            found.emplace_back(wanted[path], std::move(numbers));
        }
        // A snapshot of a stopped run must not make a window too short.
        if (!past.empty() &&
            now.clock.extension - past.back().places.extension < least_window(run.scene))
            continue;
        Past next{DiscPlaces(now), find_basins(measure_profile(run.scene, now, run.parts.base)), {}};
        if (!past.empty())
            next.throw_correlations =
                throw_age_correlations(run.scene, run.parts.base, now, past.back().places);
        past.push_back(std::move(next));
        places.push_back(past.back().places);
    }
    return found;
}

} // namespace listric::archive
