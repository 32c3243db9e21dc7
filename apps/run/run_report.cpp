#include "apps/run/run_report.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/setting.hpp"
#include "apps/figures/report_page.hpp"
#include "apps/figures/report_run.hpp"
#include "apps/support/file.hpp"

#include <exception>
#include <utility>

namespace listric {

using namespace archive;

void RunReport::attempt(const std::function<void()>& work) {
    if (!wanted_)
        return;
    try {
        work();
    } catch (const std::exception& error) {
        log_.say(std::string("warning: no report: ") + error.what());
        wanted_ = false;
    }
}

void RunReport::read_moments(const std::vector<std::filesystem::path>& window_ends,
                             const RunHistory& history) {
    attempt([&] {
        RunFolder folder(output_, scene_);
        folder.snapshots = window_ends;
        mean_radius_ = add_moments(moments_, folder, history, lines_,
                                   {.most_bytes = most_of_report, .ends_there = false});
        limit();
    });
}

void RunReport::add(const Observation& now, const RunHistory& history) {
    attempt([&] {
        const measures::FaultReport faults =
            active_faults(make_setting(now.scene, now.parts), now.parts.base, now.state, history);
        keep(now, section_lines(now, faults, false));
    });
}

void RunReport::add(const Observation& now, const measures::FaultReport& faults,
                    const std::vector<fem::StressPatch>& footwall) {
    attempt([&] { keep(now, section_lines(now, faults, true, footwall)); });
}

void RunReport::keep(const Observation& now, SectionLines lines) {
    mean_radius_ = now.state.mean_radius;
    moments_.add(now, lines_[now.state.clock.extension] = std::move(lines));
    limit();
}

void RunReport::limit() {
    if (static_cast<double>(moments_.bytes()) <= most_of_report)
        return;
    overflows_ = true;
    moments_ = ReportMoments();
    lines_.clear();
    if (live_)
        log_.say("report: no longer live, for so many moments are too much; it comes at the end");
}

void RunReport::write_page(const std::string& history, const std::string& summary, bool live) {
    if (overflows_) {
        if (!live)
            report_run({.outputs = {output_}});
        return;
    }
    const ReportPage page{.runs = {{scene_, moments_, mean_radius_, history, summary}},
                          .live = live};
    std::string html = report_html(page);
    if (live || static_cast<double>(html.size()) <= 1e6 * ReportRequest{}.most_mb)
        return write_text(output_ / "report.html", html);
    log_.progress("report: less of each moment, so that the file is small enough");
    report_run({.outputs = {output_}}, lines_);
}

void RunReport::write_live(const std::string& history) {
    if (live_)
        attempt([&] { write_page(history, "", true); });
}

void RunReport::write(const std::string& history, const std::string& summary) {
    attempt([&] { write_page(history, summary, false); });
}

} // namespace listric
