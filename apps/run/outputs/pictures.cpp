#include "apps/archive/examine.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/figures.hpp"
#include "apps/figures/well_figure.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/machine/memory.hpp"

#include <exception>
#include <future>
#include <memory>
#include <span>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

/// Pictures at the scene's extensions and at the end, drawn by a process beside the run.
class Pictures {
public:
    void window(RunView& run) {
        if (run.is_drawn())
            draw(run);
    }

    /// Draws those of ended windows that a killed session has not come to.
    void resume(RunView& run) {
        for (const fs::path& path : run.ended_windows()) {
            const double end =
                *run.names().window_end(*moment_of_snapshot(path.filename().string()));
            const fs::path picture =
                folder(run) / ("overview-" + run.names().kilometres(end) + "km.png");
            std::error_code error;
            if (is_drawn_at(run.scene, end) && !fs::exists(picture, error))
                draw(run, path);
        }
    }

    void finish(RunView& run) {
        if (drawn_at_ != run.travel())
            draw(run);
    }

    void close(RunView& run) {
        draw_sheet(run);
        for (std::future<std::string>& picture : pending_)
            if (const std::string problem = picture.get(); !problem.empty())
                warn(run, problem);
        pending_.clear();
    }

private:
    static fs::path folder(const RunView& run) { return run.options.output / "figures"; }

    void draw(RunView& run) {
        drawn_at_ = run.travel();
        pending_.push_back(draw_figures(run.now(), run.faults(), folder(run), run.names()));
    }

    /// Draws the moment of a snapshot.
    void draw(const RunView& run, const fs::path& snapshot) {
        try {
            const Moment then = RunFolder(run.options.output, run.scene).read(snapshot);
            pending_.push_back(
                draw_figures({run.scene, run.parts, then.state, then.events},
                             report_faults(run.setting, run.parts.base, then.state, run.past),
                             folder(run), run.names()));
        } catch (const std::exception& failure) {
            warn(run, words_of(failure));
        }
    }

    /// Draws the moments of the experiment on one sheet.
    static void draw_sheet(const RunView& run) {
        try {
            const RunFolder folder(run.options.output, run.scene);
            if (run.parts.base_moves)
                draw_base(folder, folder.output, folder.output / "figures",
                          {.provenance = provenance(run.scene)});
            draw_wells(folder, std::span(&folder.snapshots.back(), 1), {},
                       folder.output / "figures", {.provenance = provenance(run.scene)});
            draw_experiment(folder, run.past);
        } catch (const std::exception& failure) {
            warn(run, words_of(failure));
        }
    }

    static void warn(const RunView& run, const std::string& problem) {
        run.log.say("warning: no figures: " + problem);
    }

    std::optional<dem::Travel> drawn_at_;
    std::vector<std::future<std::string>> pending_; ///< each says what is wrong
};

} // namespace

std::optional<Output> outputs::pictures(const RunView& run) {
    if (!run.options.figures)
        return std::nullopt;
    const auto pictures = std::make_shared<Pictures>();
    return Output{.part = Part::figures,
                  .resume = [=](RunView& r) { pictures->resume(r); },
                  .window = [=](RunView& r) { pictures->window(r); },
                  .finish = [=](RunView& r) { pictures->finish(r); },
                  .close = [=](RunView& r) { pictures->close(r); }};
}

} // namespace listric
