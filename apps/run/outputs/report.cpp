#include "apps/archive/examine.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/figures/report_page.hpp"
#include "apps/figures/report_run.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/memory.hpp"

#include <exception>
#include <functional>
#include <memory>
#include <utility>

namespace listric {

using namespace archive;

namespace {

/// report.html: a window adds to it. What goes wrong with it is a warning, and the end of the
/// report, not of the run.
class Report {
public:
    /// Adds the present moment, or other lines to the last one. Faults are followed back where
    /// they are known; then the stress below an elastic base is shown, too.
    void add(RunView& run) {
        const bool followed = run.knows_faults();
        if (overflows_ || moments_.has(run.travel(), followed))
            return;
        attempt(run, [&] {
            const Observation now = run.now();
            const fem::Footwall* const footwall = followed ? run.footwall() : nullptr;
            const auto stress = footwall ? footwall->stress() : std::vector<fem::StressPatch>();
            SectionLines lines = followed ? section_lines(now, run.faults(), true, stress)
                                          : section_lines(now,
                                                          active_faults(run.setting, run.parts.base,
                                                                        run.state(), run.past),
                                                          false);
            mean_radius_ = now.state.mean_radius;
            moments_.add(now, lines_[run.travel()] = std::move(lines));
            limit(run);
        });
    }

    void window(RunView& run) {
        add(run);
        if (run.options.live)
            attempt(run, [&] { write(run, true); });
    }

    void resume(RunView& run) {
        attempt(run, [&] {
            RunFolder folder(run.options.output, run.scene);
            folder.snapshots = run.ended_windows();
            mean_radius_ = add_moments(moments_, folder, run.past, lines_,
                                       {.most_bytes = most_of_report, .ends_there = false});
            limit(run);
        });
    }

    void finish(RunView& run) {
        run.faults();
        add(run);
    }

    void close(RunView& run) {
        attempt(run, [&] { write(run, false); });
    }

private:
    void attempt(RunView& run, const std::function<void()>& work) {
        if (has_failed_)
            return;
        try {
            work();
        } catch (const std::exception& error) {
            run.log.say(std::string("warning: no report: ") + words_of(error));
            has_failed_ = true;
        }
    }

    /// A report that takes too much memory is made again at the end, from the snapshots.
    void limit(RunView& run) {
        if (static_cast<double>(moments_.bytes()) <= most_of_report)
            return;
        overflows_ = true;
        moments_ = ReportMoments();
        lines_.clear();
        if (run.options.live)
            run.log.say("report: no longer live, for so many moments are too much; it comes at the "
                        "end");
    }

    void write(RunView& run, bool live) {
        const std::filesystem::path& output = run.options.output;
        if (overflows_) {
            if (!live)
                report_run({.outputs = {output}});
            return;
        }
        const ReportPage page{.runs = {{.scene = run.scene,
                                        .moments = moments_,
                                        .mean_radius = mean_radius_,
                                        .history = to_csv(run.record.history),
                                        .summary = run.summary,
                                        .base_moves = run.parts.base_moves,
                                        .rocks = run.rocks}},
                              .live = live};
        const std::string html = report_html(page);
        if (live || static_cast<double>(html.size()) <= 1e6 * ReportRequest{}.most_mb)
            return write_text(output / "report.html", html);
        run.log.progress("report: less of each moment, so that the file is small enough");
        report_run({.outputs = {output}}, lines_);
    }

    bool has_failed_ = false;
    bool overflows_ = false; ///< moments are no longer kept
    double mean_radius_ = 0.0;
    ReportMoments moments_;
    LinesOfMoments lines_;
};

} // namespace

std::optional<Output> outputs::report(const RunView& run) {
    if (!run.options.report || !run.scene.output.report)
        return std::nullopt;
    const auto report = std::make_shared<Report>();
    return Output{.part = Part::report,
                  .begin = [=](RunView& r) { report->add(r); },
                  .resume = [=](RunView& r) { report->resume(r); },
                  .window = [=](RunView& r) { report->window(r); },
                  .finish = [=](RunView& r) { report->finish(r); },
                  .close = [=](RunView& r) { report->close(r); }};
}

} // namespace listric
