#include "apps/run/run_view.hpp"

#include "apps/archive/dictionary.hpp"
#include "apps/archive/examine.hpp"
#include "apps/archive/run_files.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/setting.hpp"
#include "apps/archive/summary.hpp"
#include "apps/model/model.hpp"
#include "dem/ranks/ranked_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

RunView::RunView(const Scene& s, const RunOptions& o, Log& l, const dem::Simulation& of)
    : scene(s), options(o), log(l), simulation(of), parts(make_parts(s)),
      setting(make_setting(s, parts)) {}

int RunView::ranks() const { return options.on_ranks ? options.on_ranks->ranks() : 1; }

MomentNames RunView::names() const { return {scene.output.interval, window_ends(record.history)}; }

/// The first multiple of the interval that has not been reached; windows shorter than a cycle are
/// passed over. Windows are counted, not summed up, so that a resumed run has the same ends.
double RunView::next_window_end() const {
    const double window = scene.output.interval, tolerance = simulation.tolerance();
    double count = std::floor((extension() + tolerance) / window);
    while (extension() >= count * window - tolerance)
        count += 1.0;
    return count * window;
}

bool RunView::is_drawn() const { return is_drawn_at(scene, extension()); }

fs::path RunView::snapshot() const {
    return options.output / "snapshots" / snapshot_name(names().metres(extension()));
}

std::vector<fs::path> RunView::ended_windows() const {
    const MomentNames moments = names();
    std::vector<fs::path> ended = list_snapshots(options.output);
    std::erase_if(ended, [&](const fs::path& path) {
        const auto end = moments.window_end(*moment_of_snapshot(path.filename().string()));
        return !end || *end > extension();
    });
    return ended;
}

/// Makes what is not there of the present moment.
template <class T, class Make> const T& RunView::made_once(Made<T>& made, Make&& make) {
    if (!made.is_of(extension())) {
        const PartWatch time = watch(Part::measures);
        made = {make(), extension()};
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

void RunView::require_elasticity() const {
    if (window_of_base.beyond_elasticity)
        throw BeyondElasticity(*window_of_base.beyond_elasticity);
}

double RunView::seconds_left() const {
    const double share = std::max(1e-3, extension() / target());
    return extension() > 0.0 ? std::max(0.0, wall_seconds() / share * (1.0 - share))
                             : record.predicted_seconds;
}

std::string RunView::progress() const {
    const auto cycling = record.seconds_by_part.find(name(Part::cycle));
    const double seconds = cycling == record.seconds_by_part.end() ? 0.0 : cycling->second;
    return fmt::format("cycle {}  extension {}  {:.1f} M disc-steps/s  {} left",
                       state().clock.cycle, way_text(extension(), target()),
                       record.disc_steps / std::max(1e-9, seconds) / 1e6,
                       rough_duration(seconds_left()));
}

void RunView::go_on_with(RunRecord earlier) {
    record = std::move(earlier);
    seconds_before_ += total(record.seconds_by_part);
}

} // namespace listric
