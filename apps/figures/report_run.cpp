#include "apps/figures/report_run.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/run_history.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/archive/reservations.hpp"
#include "apps/archive/tables/rock_record.hpp"
#include "apps/figures/report_page.hpp"
#include "apps/model/base_driver.hpp"
#include "apps/model/model.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <iterator>
#include <map>
#include <memory>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

/// Stages of leaving out, each of which leaves out more.
struct Reduction {
    ReportDetail detail;
    const char* left_out;
};

constexpr Reduction reductions[] = {
    {{}, ""},
    {{false, true, 1}, "bonds"},
    {{false, false, 1}, "bonds and stress"},
    {{false, false, 2}, "bonds, stress and every second snapshot"},
    {{false, false, 4}, "bonds, stress and three of four snapshots"},
    {{false, false, 8}, "bonds, stress and seven of eight snapshots"},
};

/// A run that has been read.
struct ReadRun {
    RunFolder folder;
    RunHistory history;
    LinesOfMoments lines = {};
    ReportMoments moments = ReportMoments();
    double mean_radius = 0.0;
};

/// Throws UsageError if it is no folder of a section's run.
ReadRun opened(const fs::path& output) {
    if (list_snapshots(output).empty())
        throw UsageError(output.string() + ": no snapshots to report on; is this a run's folder?");
    RunFolder folder = shown_run(output);
    RunHistory history(folder);
    return {std::move(folder), std::move(history)};
}

ReportPage page_of(const std::vector<ReadRun>& runs, const Reduction& reduction,
                   const std::optional<Underlay>& underlay) {
    ReportPage page{.runs = {}, .left_out = reduction.left_out, .underlay = underlay};
    std::error_code error;
    for (const ReadRun& run : runs) {
        const fs::path& folder = run.folder.output;
        page.runs.push_back({run.folder.scene, run.moments, run.mean_radius,
                             to_csv(run.folder.moments.history),
                             read_text_if_there(folder / "summary.json"), (folder / "").string(),
                             fs::exists(folder / "summary.json", error),
                             run.folder.parts.base_moves, recorded_rocks(folder)});
    }
    return page;
}

/// A moment whose lines are being made; none if they are there.
struct Drawn {
    std::shared_ptr<const Moment> moment;
    std::future<SectionLines> lines = {};
};

/// The stress below the base of a run's snapshots; none where it is not known.
class FootwallReader {
public:
    explicit FootwallReader(const RunFolder& folder) {
        try {
            driver_ = make_base_driver(folder.scene, folder.parts, {}, events_);
        } catch (const UsageError&) { // without its plug-in the report has the discs alone
        }
    }

    std::vector<fem::StressPatch> read(const fs::path& path) {
        if (!driver_)
            return {};
        Snapshot snapshot = read_snapshot(path);
        hand_over(snapshot, events_, path);
        try {
            const fem::Footwall* footwall = driver_->recover(snapshot.state);
            return footwall ? footwall->stress() : std::vector<fem::StressPatch>();
        } catch (const UsageError& error) { // the mesh's file is another by now: likewise
            warn(fmt::format("the report has no stress below the base: {}", error.what()));
            driver_.reset();
            return {};
        }
    }

private:
    std::vector<std::unique_ptr<dem::Event>> events_;
    std::unique_ptr<BaseDriver> driver_;
};

} // namespace

double add_moments(ReportMoments& moments, const RunFolder& folder, const RunHistory& history,
                   LinesOfMoments& made, const MomentChoice& choice) {
    const measures::Setting setting = make_setting(folder.scene, folder.parts);
    const auto observe = [&](const Moment& moment) -> Observation {
        return {folder.scene, folder.parts, moment.state, moment.events};
    };
    const auto is_drawn = [&](const fs::path& path) {
        return (choice.ends_there && path == folder.snapshots.back()) ||
               is_drawn_at(folder.scene, snapshot_extension(path));
    };
    FootwallReader footwall(folder);
    // Files are read in this thread; lines, which take longest, are made beside it.
    std::map<fs::path, Drawn> drawn;
    const auto draw = [&](const fs::path& path) {
        if (drawn.contains(path))
            return;
        const auto moment = std::make_shared<const Moment>(folder.read(path));
        const bool followed = choice.every_line || is_drawn(path);
        const auto known = made.find(moment->state.clock.travel);
        if (known != made.end() && known->second.followed >= followed) {
            drawn[path] = {moment};
            return;
        }
        auto lines = [&, moment, followed,
                      stress = followed ? footwall.read(path) : std::vector<fem::StressPatch>()] {
            const auto faults = (followed ? report_faults : active_faults)(
                setting, folder.parts.base, moment->state, history);
            return section_lines(observe(*moment), faults, followed, stress);
        };
        drawn[path] = {moment, std::async(std::launch::async, std::move(lines))};
    };
    std::vector<fs::path> shown;
    for (std::size_t k = 0; k < folder.snapshots.size(); ++k) {
        const fs::path& path = folder.snapshots[k];
        if (is_drawn(path))
            draw(path); // takes longer than the others
        if (is_drawn(path) || k % static_cast<std::size_t>(choice.every) == 0)
            shown.push_back(path);
    }
    const auto keep_lines = [&](Drawn& now) {
        if (now.lines.valid())
            made[now.moment->state.clock.travel] = now.lines.get();
    };
    double mean_radius = 0.0;
    for (std::size_t k = 0;
         k < shown.size() && static_cast<double>(moments.bytes()) <= choice.most_bytes; ++k) {
        for (std::size_t ahead = k; ahead < std::min(k + 2, shown.size()); ++ahead)
            draw(shown[ahead]);
        Drawn& now = drawn.at(shown[k]);
        keep_lines(now);
        moments.add(observe(*now.moment), made.at(now.moment->state.clock.travel));
        mean_radius = now.moment->state.mean_radius;
        drawn.erase(shown[k]);
    }
    for (auto& [path, ahead] : drawn)
        keep_lines(ahead);
    return mean_radius;
}

WrittenReport report_run(const ReportRequest& request, LinesOfMoments lines) {
    std::vector<ReadRun> runs;
    for (const fs::path& output : request.outputs)
        runs.push_back(opened(output));
    runs.front().lines = std::move(lines);
    const double most_bytes = 1e6 * request.most_mb;
    std::string html;
    std::vector<std::string> lacks;
    for (const Reduction& reduction : reductions) {
        const bool is_last = &reduction == std::end(reductions) - 1;
        double bytes = 0.0;
        for (ReadRun& run : runs) {
            run.moments = ReportMoments(reduction.detail);
            run.mean_radius = add_moments(run.moments, run.folder, run.history, run.lines,
                                          {.every = reduction.detail.every,
                                           .every_line = request.every_line,
                                           .most_bytes = is_last ? 1e300 : most_bytes});
            bytes += static_cast<double>(run.moments.bytes());
        }
        if (bytes > most_bytes && !is_last)
            continue;
        const ReportPage page = page_of(runs, reduction, request.underlay);
        lacks = lacks_of(page);
        html = report_html(page);
        if (static_cast<double>(html.size()) <= most_bytes)
            break;
    }
    const auto size = static_cast<double>(html.size()) / 1e6;
    if (size > request.most_mb)
        throw UsageError(fmt::format("report: without {} the file still has {:.1f} MB; allow more "
                                     "than --most-mb {:g}",
                                     std::end(reductions)[-1].left_out, size, request.most_mb));
    const fs::path file =
        request.file.empty() ? request.outputs.front() / "report.html" : request.file;
    write_text(file, html);
    return {file, std::move(lacks)};
}

} // namespace listric
