#include "apps/run/passed_moments.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/run_files.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/setting.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/figures.hpp"

#include <exception>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

std::string moment_of(const fs::path& snapshot) {
    return *moment_of_snapshot(snapshot.filename().string());
}

} // namespace

std::vector<fs::path> ended_windows(const fs::path& output, const MomentNames& names,
                                    double extension) {
    std::vector<fs::path> ended;
    for (const fs::path& path : list_snapshots(output))
        if (const auto end = names.window_end(moment_of(path)); end && *end <= extension)
            ended.push_back(path);
    return ended;
}

void remove_passed_stops(const fs::path& output, const MomentNames& names, double extension) {
    const std::string present = names.metres(extension);
    std::error_code error;
    for (const fs::path& path : list_snapshots(output)) {
        const std::string moment = moment_of(path);
        const double stop = snapshot_extension(path);
        if (moment == present || stop > extension || names.window_end(moment))
            continue;
        for (const fs::path& file : files_of_moment(output, moment, names.kilometres(stop)))
            fs::remove(file, error);
        fs::remove(path, error);
    }
}

std::vector<std::future<std::string>> draw_missing(const fs::path& output, const Scene& scene,
                                                   const MomentNames& names,
                                                   const std::vector<fs::path>& ended,
                                                   const RunHistory& history) {
    std::vector<std::future<std::string>> drawn;
    const fs::path figures = output / "figures";
    for (const fs::path& path : ended) {
        const double end = *names.window_end(moment_of(path));
        std::error_code error;
        if (!is_drawn_at(scene, end) ||
            fs::exists(figures / ("overview-" + names.kilometres(end) + "km.png"), error))
            continue;
        try {
            const RunFolder run(output, scene);
            const Moment moment = run.read(path);
            const Observation then{run.scene, run.parts, moment.state, moment.events};
            drawn.push_back(draw_figures(then,
                                         report_faults(make_setting(run.scene, run.parts),
                                                       run.parts.base, moment.state, history),
                                         figures, names));
        } catch (const std::exception& failure) {
            std::promise<std::string> problem;
            problem.set_value(failure.what());
            drawn.push_back(problem.get_future());
        }
    }
    return drawn;
}

} // namespace listric
