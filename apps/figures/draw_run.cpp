#include "apps/figures/draw_run.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/figures.hpp"
#include "apps/figures/flexure_figure.hpp"
#include "apps/support/error.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace listric {

namespace fs = std::filesystem;

bool is_drawn_at(const Scene& scene, double extension) {
    return std::ranges::any_of(scene.output.figures, [&](double mark) {
        return std::abs(mark - extension) <= 0.5 * scene.output.interval;
    });
}

namespace {

/// A run's folder, to be drawn again.
struct Drawing : RunFolder {
    /// @param history  earlier snapshots in which the faults' history is looked up
    void add(FigureFrames& frames, const fs::path& path, std::span<const fs::path> history) const {
        const Moment moment = read(path);
        frames.add(scene, moment.state, base, moment.events,
                   report_faults(scene, base, moment.state, history));
    }

    /// Snapshots at the scene's figure extensions, and the newest.
    std::vector<fs::path> chosen() const {
        std::vector<fs::path> paths;
        for (const fs::path& path : snapshots)
            if (path == snapshots.back() || is_drawn_at(scene, snapshot_extension(path)))
                paths.push_back(path);
        return paths;
    }
};

/// Throws UsageError if there is nothing to draw.
Drawing open_drawing(const fs::path& output) {
    if (list_snapshots(output).empty())
        throw UsageError(output.string() + ": no snapshots to draw; is this a run's folder?");
    return Drawing{RunFolder(output)};
}

} // namespace

void draw_run(const fs::path& output) {
    std::error_code error;
    if (fs::exists(output / "deflection.csv", error)) {
        if (const std::string problem = draw_flexure(output); !problem.empty())
            throw StorageError(problem);
        return;
    }
    const Drawing drawing = open_drawing(output);
    const std::vector<fs::path> chosen = drawing.chosen();
    FigureFrames frames(output / "figures");
    for (const fs::path& path : chosen)
        drawing.add(frames, path, drawing.snapshots);
    frames.draw("sections");
    if (chosen.size() > 1)
        frames.draw("experiment");
    if (drawing.scene.elastic_base || drawing.scene.base_motion)
        draw_base(output);
}

void draw_experiment(const fs::path& output) {
    const Drawing drawing = open_drawing(output);
    const std::vector<fs::path> chosen = drawing.chosen();
    if (chosen.size() < 2)
        return;
    FigureFrames frames(output / "figures");
    for (const fs::path& path : chosen)
        drawing.add(frames, path, drawing.snapshots);
    frames.draw("experiment");
}

void animate_run(const fs::path& output) {
    const Drawing drawing = open_drawing(output);
    FigureFrames frames(output / "figures");
    for (std::size_t k = 0; k < drawing.snapshots.size(); ++k) {
        // The window before shows where the faults are; their history is not drawn.
        const std::size_t before = std::min<std::size_t>(k, 1);
        drawing.add(frames, drawing.snapshots[k],
                    std::span(drawing.snapshots).subspan(k - before, before));
    }
    frames.draw("animation");
}

} // namespace listric
