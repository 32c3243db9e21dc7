#include "apps/run/run_view.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/archive/tables/dictionary.hpp"
#include "apps/archive/tables/rock_record.hpp"
#include "apps/model/effects/stage/pauses.hpp"
#include "apps/model/model.hpp"
#include "apps/run/progress_line.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/version.hpp"
#include "dem/ranks/ranked_cycles.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

RunView::RunView(const Scene& s, const RunOptions& o, Log& l, const dem::Simulation& of)
    : scene(s), options(o), log(l), simulation(of), parts(make_parts(s)),
      setting(make_setting(s, parts)) {}

int RunView::ranks() const { return options.on_ranks ? options.on_ranks->ranks() : 1; }

MomentNames RunView::names() const {
    MomentNames names(scene.output.interval, window_ends(record.history));
    const double tolerance = simulation.tolerance().m;
    names.name_after(target().m, tolerance);
    if (!kept.empty()) // a resumed run was asked for another end before
        names.name_after(snapshot_extension(kept), tolerance);
    return names;
}

/// The first multiple of the interval that has not been reached; windows shorter than a cycle are
/// passed over. Windows are counted, not summed up, so that a resumed run has the same ends.
dem::Travel RunView::next_window_end() const {
    const dem::Travel window(scene.output.interval), tolerance = simulation.tolerance();
    double count = std::floor((travel() + tolerance) / window);
    while (has_come_to(travel(), count * window, tolerance))
        count += 1.0;
    return count * window;
}

bool RunView::is_drawn() const { return is_drawn_at(scene, travel().m); }

fs::path RunView::snapshot() const {
    return options.output / "snapshots" / snapshot_name(names().metres(travel().m));
}

std::vector<fs::path> RunView::ended_windows() const {
    const MomentNames moments = names();
    std::vector<fs::path> ended = list_snapshots(options.output);
    std::erase_if(ended, [&](const fs::path& path) {
        const auto end = moments.window_end(*moment_of_snapshot(path.filename().string()));
        return !end || *end > travel().m;
    });
    return ended;
}

/// Makes what is not there of the present moment.
template <class T, class Make> const T& RunView::made_once(Made<T>& made, Make&& make) {
    if (!made.is_of(travel())) {
        const PartWatch time = watch(Part::measures);
        made = {make(), travel()};
    }
    return *made.value;
}

const measures::Measures& RunView::measured() {
    return made_once(measures_, [&] {
        return measures::measure(setting, state(), parts.base, simulation.events());
    });
}

const measures::FaultReport& RunView::faults() {
    return made_once(faults_, [&] { return report_faults(setting, parts.base, state(), past); });
}

NamedNumbers RunView::row() {
    NamedNumbers row = history_row(state(), measured());
    append(row, measure_effects(now()).numbers);
    append(row, window_of_base.measures);
    return row;
}

void RunView::add_row() {
    const NamedNumbers values = row();
    dem::Table& history = record.history;
    for (const auto& [name, value] : values)
        if (!history.has(name))
            history.add<double>(name, unit_of(name, scene), std::nan(""));
    history.resize(history.rows() + 1);
    for (const auto& [name, value] : values)
        history.get<double>(name).back() = value;
}

std::string RunView::place_text(std::optional<double> interval) const {
    const auto text = [&](double length) {
        const double metres = std::round(length); // what was asked for, to half a cycle
        if (std::abs(length - metres) <= simulation.tolerance().m)
            length = metres + 0.0;
        return interval ? length_text(length, *interval) : length_text(length);
    };
    return has_stages() ? fmt::format("{} of net extension after {} of {}", text(extension().m),
                                      text(travel().m),
                                      effects::stage::name_of_way(parts.base.motion, travel()))
                        : fmt::format("{} of extension", text(extension().m));
}

void RunView::require_elasticity() const {
    if (window_of_base.beyond_elasticity)
        throw BeyondElasticity(*window_of_base.beyond_elasticity);
}

void RunView::count_cycles() {
    const dem::Clock& clock = state().clock;
    const dem::Motion& motion = simulation.base().motion;
    const double to_go = motion.time_at(target()) - motion.time_at(std::min(travel(), target()));
    const auto done = static_cast<double>(clock.cycle);
    time_left_.read(done, done + to_go / clock.time_step, seconds_since(started_));
}

void RunView::show_progress(const std::string& what) {
    log.progress([&](std::size_t columns) {
        return progress_line({time_left_.share_done(seconds_since(started_)),
                              what.empty() ? way_text(travel().m, target().m) : what,
                              seconds_left(), std::time(nullptr)},
                             columns);
    });
}

void RunView::begin_record() {
    record.scene = to_toml(scene);
    rocks = known_rocks(scene);
}

void RunView::go_on_with(const fs::path& snapshot, RunRecord earlier) {
    kept = snapshot;
    record = std::move(earlier);
    rocks = recorded_rocks(options.output);
    std::vector<std::string>& versions = record.earlier_versions;
    const std::string writer = std::exchange(record.written_by, {});
    if (writer != version && std::ranges::find(versions, writer) == versions.end())
        versions.push_back(writer);
    if (!versions.empty())
        log.say(fmt::format("warning: listric {} has made this run so far, and {} goes on with it: "
                            "its numbers may be those of neither; --force begins again",
                            fmt::join(versions, ", "), version));
    seconds_before_ += total(record.seconds_by_part);
    past = RunHistory(ended_windows());
}

} // namespace listric
