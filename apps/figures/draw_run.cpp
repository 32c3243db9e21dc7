#include "apps/figures/draw_run.hpp"

#include "apps/archive/error_sentence.hpp"
#include "apps/archive/examine.hpp"
#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/run_history.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/reservations.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/figures.hpp"
#include "apps/figures/sections/seismic_section.hpp"
#include "apps/figures/well_figure.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

/// Throws UsageError if there is nothing to draw.
RunFolder open_run(const fs::path& output) {
    if (list_snapshots(output).empty())
        throw UsageError(output.string() + ": no snapshots to draw; is this a run's folder?");
    return shown_run(output);
}

fs::path pictures_of(const fs::path& output, const fs::path& elsewhere) {
    return elsewhere.empty() ? output / "figures" : elsewhere;
}

/// Snapshots at the scene's figure extensions, and the newest.
std::vector<fs::path> chosen_snapshots(const RunFolder& run) {
    std::vector<fs::path> paths;
    for (const fs::path& path : run.snapshots)
        if (path == run.snapshots.back() || is_drawn_at(run.scene, snapshot_extension(path)))
            paths.push_back(path);
    return paths;
}

/// Files of a folder that a call writes.
class WrittenFiles {
public:
    explicit WrittenFiles(const fs::path& folder) : folder_(folder), before_(times()) {}

    /// Those that are new, or newer than before, by name.
    std::vector<fs::path> since() const {
        std::vector<fs::path> files;
        for (const auto& [file, time] : times())
            if (const auto old = before_.find(file); old == before_.end() || old->second != time)
                files.push_back(file);
        return files;
    }

private:
    std::map<fs::path, fs::file_time_type> times() const {
        std::map<fs::path, fs::file_time_type> all;
        std::error_code error;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error))
            if (entry.is_regular_file(error))
                all[entry.path()] = entry.last_write_time(error);
        return all;
    }

    fs::path folder_;
    std::map<fs::path, fs::file_time_type> before_;
};

/// Throws UsageError if a run has no panel of such a name.
void require_panels(const RunFolder& run, const std::vector<std::string>& wanted) {
    std::vector<std::string> layers;
    for (const FigureLayer& layer : figure_layers(run.scene))
        if (layer.kind == LayerKind::discs)
            layers.push_back(fmt::format("layer-{}", layer.name));
    std::vector<std::string_view> known(std::begin(panel_names), std::end(panel_names));
    known.insert(known.end(), layers.begin(), layers.end());
    for (const std::string& panel : wanted) {
        if (std::ranges::find(known, panel) == known.end())
            throw UsageError(fmt::format("--only: no panel {}; {}", panel, advice(panel, known)));
        if (panel.starts_with("seismic") && !has_seismics(run.scene))
            throw UsageError(fmt::format("--only {}: needs a hanging wall of 1 km or more", panel));
    }
}

void add_frame(FigureFrames& frames, const RunFolder& run, const Moment& moment,
               const RunHistory& history) {
    frames.add(
        {run.scene, run.parts, moment.state, moment.events},
        report_faults(make_setting(run.scene, run.parts), run.parts.base, moment.state, history));
}

} // namespace

std::vector<fs::path> draw_run(const FiguresRequest& request) {
    const fs::path& output = request.output;
    const fs::path pictures = pictures_of(output, request.pictures);
    const WrittenFiles written(pictures);
    std::error_code error;
    if (fs::exists(output / "deflection.csv", error)) {
        PictureOrder order = request.order;
        order.provenance = object_at(object_in(output / "summary.json"), "provenance");
        warn_of(output, reservations(output));
        make_result_folder(pictures);
        draw_flexure(output, pictures, order);
        return written.since();
    }
    const RunFolder run = open_run(output);
    require_panels(run, request.order.only);
    make_result_folder(pictures);
    PictureOrder order = request.order;
    order.provenance = provenance_of_run(output, run.scene);
    order.errors = error_sentence(object_in(output / "summary.json"));
    const std::vector<fs::path> chosen =
        request.extensions.empty() ? chosen_snapshots(run) : run.snapshots_at(request.extensions);
    const bool sections_alone = !order.only.empty() || order.width_mm > 0.0;
    const bool has_wells = (!request.wells.empty() || !sections_alone) &&
                           draw_wells(run, chosen, request.wells, pictures, order);
    if (!request.wells.empty()) {
        if (!has_wells)
            throw UsageError(fmt::format("--well {}: no pore water under pressure there",
                                         fmt::join(request.wells, ",")));
        return written.since();
    }
    FigureFrames frames(pictures, request.underlay, order, run.names);
    const RunHistory history(run);
    bool base_moves = false;
    for (const fs::path& path : chosen) {
        const Moment moment = run.read(path);
        base_moves |= moment.state.base_nodes.rows() > 0;
        add_frame(frames, run, moment, history);
    }
    frames.draw("sections");
    if (request.extensions.empty() && !sections_alone) {
        if (chosen.size() > 1)
            frames.draw("experiment");
        if (base_moves)
            draw_base(run, request.pictures.empty() ? output : pictures, pictures, order);
    }
    return written.since();
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

std::vector<fs::path> animate_run(const fs::path& output, const std::vector<std::string>& formats,
                                  const fs::path& elsewhere) {
    const fs::path pictures = pictures_of(output, elsewhere);
    const WrittenFiles written(pictures);
    const RunFolder run = open_run(output);
    make_result_folder(pictures);
    FigureFrames frames(pictures, std::nullopt, {.formats = formats}, run.names);
    // The window before shows where the faults are; their history is not drawn.
    RunHistory window;
    for (const fs::path& path : run.snapshots) {
        const Moment moment = run.read(path);
        add_frame(frames, run, moment, window);
        window = {};
        window.add(measures::DiscPlaces(moment.state));
    }
    frames.draw("animation");
    return written.since();
}

} // namespace listric
