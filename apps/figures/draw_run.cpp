#include "apps/figures/draw_run.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/json_file.hpp"
#include "apps/archive/provenance.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/run_history.hpp"
#include "apps/archive/setting.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/figures.hpp"
#include "apps/figures/flexure_figure.hpp"
#include "apps/figures/well_figure.hpp"
#include "apps/support/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

/// Throws UsageError if there is nothing to draw.
RunFolder open_run(const fs::path& output) {
    if (list_snapshots(output).empty())
        throw UsageError(output.string() + ": no snapshots to draw; is this a run's folder?");
    return RunFolder(output);
}

/// Snapshots at the scene's figure extensions, and the newest.
std::vector<fs::path> chosen_snapshots(const RunFolder& run) {
    std::vector<fs::path> paths;
    for (const fs::path& path : run.snapshots)
        if (path == run.snapshots.back() || is_drawn_at(run.scene, snapshot_extension(path)))
            paths.push_back(path);
    return paths;
}

void add_frame(FigureFrames& frames, const RunFolder& run, const Moment& moment,
               const RunHistory& history) {
    frames.add(
        {run.scene, run.parts, moment.state, moment.events},
        report_faults(make_setting(run.scene, run.parts), run.parts.base, moment.state, history));
}

} // namespace

void draw_run(const fs::path& output, const std::optional<Underlay>& underlay,
              const std::vector<std::string>& formats, const std::vector<double>& extensions,
              const std::vector<double>& wells) {
    std::error_code error;
    if (fs::exists(output / "deflection.csv", error))
        return draw_flexure(output,
                            {formats, object_at(object_in(output / "summary.json"), "provenance")});
    const RunFolder run = open_run(output);
    const PictureOrder order{formats, provenance_of_run(output, run.scene)};
    const std::vector<fs::path> chosen =
        extensions.empty() ? chosen_snapshots(run) : run.snapshots_at(extensions);
    const bool has_wells = draw_wells(run, chosen, wells, order);
    if (!wells.empty()) {
        if (!has_wells)
            throw UsageError(fmt::format("--well {}: no pore water under pressure there",
                                         fmt::join(wells, ",")));
        return;
    }
    FigureFrames frames(output / "figures", underlay, order, run.names);
    const RunHistory history(run);
    bool base_moves = false;
    for (const fs::path& path : chosen) {
        const Moment moment = run.read(path);
        base_moves |= moment.state.base_nodes.rows() > 0;
        add_frame(frames, run, moment, history);
    }
    frames.draw("sections");
    if (!extensions.empty())
        return;
    if (chosen.size() > 1)
        frames.draw("experiment");
    if (base_moves)
        draw_base(run, order);
}

void draw_experiment(const RunFolder& run, const RunHistory& history) {
    const std::vector<fs::path> chosen = chosen_snapshots(run);
    if (chosen.size() < 2)
        return;
    FigureFrames frames(run.output / "figures", std::nullopt, {.provenance = provenance(run.scene)},
                        run.names);
    for (const fs::path& path : chosen)
        add_frame(frames, run, run.read(path), history);
    frames.draw("experiment");
}

void animate_run(const fs::path& output) {
    const RunFolder run = open_run(output);
    FigureFrames frames(output / "figures", std::nullopt, {}, run.names);
    // The window before shows where the faults are; their history is not drawn.
    RunHistory window;
    for (const fs::path& path : run.snapshots) {
        const Moment moment = run.read(path);
        add_frame(frames, run, moment, window);
        window = {};
        window.add(measures::DiscPlaces(moment.state));
    }
    frames.draw("animation");
}

} // namespace listric
