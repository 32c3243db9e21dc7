#include "apps/figures/report_run.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/run_history.hpp"
#include "apps/archive/setting.hpp"
#include "apps/archive/summary.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/report_page.hpp"
#include "apps/model/footwall_coupling.hpp"
#include "apps/support/error.hpp"
#include "apps/support/file.hpp"

#include <fmt/format.h>

#include <future>
#include <iterator>
#include <map>
#include <memory>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

/// What is left out, the more the further on.
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
    ReportMoments moments = ReportMoments();
    double mean_radius = 0.0;
};

/// Throws UsageError if it is no folder of a section's run.
ReadRun open_run(const fs::path& output) {
    if (list_snapshots(output).empty())
        throw UsageError(output.string() + ": no snapshots to report on; is this a run's folder?");
    RunFolder folder(output);
    RunHistory history(folder.snapshots);
    return {std::move(folder), std::move(history)};
}

std::string page_of(const std::vector<ReadRun>& runs, const Reduction& reduction,
                    const std::optional<Underlay>& underlay) {
    ReportPage page{.runs = {}, .left_out = reduction.left_out, .underlay = underlay};
    for (const ReadRun& run : runs)
        page.runs.push_back({run.folder.scene, run.moments, run.mean_radius,
                             read_text_if_there(run.folder.output / "history.csv"),
                             read_text_if_there(run.folder.output / "summary.json")});
    return report_html(page);
}

/// A moment whose faults are being followed back.
struct Followed {
    std::shared_ptr<const Moment> moment;
    std::future<measures::FaultReport> faults;
};

template <class Report> Followed follow(Moment moment, Report report) {
    const auto kept = std::make_shared<const Moment>(std::move(moment));
    return {kept, std::async(std::launch::async, [kept, report] { return report(*kept); })};
}

/// The stress below the base of a run's snapshots; none where the base is rigid.
class FootwallReader {
public:
    explicit FootwallReader(const RunFolder& folder) {
        if (!has_effect(folder.scene, "elastic_base"))
            return;
        try {
            coupling_.emplace(folder.scene, folder.parts, events_);
        } catch (const UsageError&) { // without its plug-in the report has the discs alone
        }
    }

    std::vector<fem::StressPatch> read(const fs::path& path) {
        if (!coupling_)
            return {};
        Snapshot snapshot = read_snapshot(path);
        hand_over(snapshot, events_);
        return coupling_->recover(snapshot.state).stress();
    }

private:
    std::vector<std::unique_ptr<dem::Event>> events_;
    std::optional<FootwallCoupling> coupling_;
};

} // namespace

double add_moments(ReportMoments& moments, const RunFolder& folder, const RunHistory& history,
                   int every, bool every_line) {
    const measures::Setting setting = make_setting(folder.scene, folder.parts);
    const dem::RigidBase& base = folder.parts.base;
    const auto is_last = [&](const fs::path& path) { return path == folder.snapshots.back(); };
    // What takes longest is begun first, and done beside the rest. Files are read in this thread.
    std::map<fs::path, Followed> followed;
    for (const fs::path& path : folder.snapshots)
        if (is_last(path) || is_drawn_at(folder.scene, snapshot_extension(path)))
            followed[path] = follow(folder.read(path), [&](const Moment& moment) {
                return report_faults(setting, base, moment.state, history);
            });
    FootwallReader footwall(folder);
    double mean_radius = 0.0;
    for (std::size_t k = 0; k < folder.snapshots.size(); ++k) {
        const fs::path& path = folder.snapshots[k];
        const auto found = followed.find(path);
        if (found == followed.end() && k % static_cast<std::size_t>(every) != 0)
            continue;
        const bool has_past = found != followed.end() || every_line;
        const auto moment = found != followed.end()
                                ? found->second.moment
                                : std::make_shared<const Moment>(folder.read(path));
        const auto faults = found != followed.end() ? found->second.faults.get()
                                                    : (every_line ? report_faults : active_faults)(
                                                          setting, base, moment->state, history);
        moments.add({folder.scene, folder.parts, moment->state, moment->events}, faults, has_past,
                    has_past ? footwall.read(path) : std::vector<fem::StressPatch>());
        mean_radius = moment->state.mean_radius;
        if (found != followed.end())
            followed.erase(found);
    }
    return mean_radius;
}

fs::path report_run(const ReportRequest& request) {
    std::vector<ReadRun> runs;
    for (const fs::path& output : request.outputs)
        runs.push_back(open_run(output));
    std::string html;
    for (const Reduction& reduction : reductions) {
        for (ReadRun& run : runs) {
            run.moments = ReportMoments(reduction.detail);
            run.mean_radius = add_moments(run.moments, run.folder, run.history,
                                          reduction.detail.every, request.every_line);
        }
        html = page_of(runs, reduction, request.underlay);
        if (static_cast<double>(html.size()) <= 1e6 * request.most_mb)
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
    return file;
}

} // namespace listric
