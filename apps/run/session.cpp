#include "apps/run/session.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/json_file.hpp"
#include "apps/archive/provenance.hpp"
#include "apps/archive/run_files.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/scene_lines.hpp"
#include "apps/archive/setting.hpp"
#include "apps/archive/summary.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/figures.hpp"
#include "apps/figures/paraview.hpp"
#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "apps/run/passed_moments.hpp"
#include "apps/run/prediction.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/file.hpp"
#include "dem/events/strain.hpp"
#include "dem/ranks/ranked_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace listric {

using namespace archive;
using namespace dem;
using namespace measures;

namespace {

namespace fs = std::filesystem;

fs::path snapshot_path(const fs::path& output, const MomentNames& names, double extension) {
    return output / "snapshots" / snapshot_name(names.metres(extension));
}

} // namespace

Session::Session(const Scene& scene, const RunOptions& options, Log& log)
    : scene_(scene), options_(options), log_(log), parts_(make_parts(scene)),
      setting_(make_setting(scene, parts_)), simulation_(parts_.base, parts_.physics),
      report_(scene, options.output, options.report && scene.output.report, options.live, log) {
    for (auto& event : make_events(scene, parts_))
        simulation_.add(std::move(event));
    simulation_.report_times_to([this](const std::string& part, double seconds) {
        record_.seconds_by_part[part] += seconds;
        if (!driver_ || part != "cycle")
            return;
        const double base = driver_->take_seconds();
        record_.seconds_by_part["base"] += base;
        record_.seconds_by_part["cycle"] -= base;
    });
    make_cycles_by(nullptr);
}

/// Cycles are made here, or on all ranks.
/// @param response  of the base; none: nothing answers to its loads
void Session::make_cycles_by(BaseResponse* response) {
    if (RankedCycles* const on_ranks = options_.on_ranks)
        simulation_.advance_by(
            [on_ranks, response](State& state, const RigidBase&, const CyclePhysics&,
                                 std::int64_t cycles, const Execution& how) {
                on_ranks->advance(state, cycles, how.state_is_untouched, response);
            },
            [on_ranks](State& state) { on_ranks->collect(state); });
    else if (response)
        simulation_.respond_by(*response);
}

/// By the windows that have ended.
MomentNames Session::names() const {
    return {scene_.output.interval, window_ends(record_.history)};
}

int Session::ranks() const { return options_.on_ranks ? options_.on_ranks->ranks() : 1; }

double Session::wall_seconds() const { return seconds_before_ + seconds_since(started_); }

double Session::target() const {
    return std::min(scene_.extension.distance, options_.until.value_or(1e300));
}

Execution Session::execution() const {
    return {options_.threads, options_.plain ? Cycle::plain : best_cycle()};
}

/// Makes what moves the base, for a scene whose base deforms.
void Session::make_driver() {
    if (!parts_.base_moves || driver_)
        return;
    const Stopwatch watch(record_.seconds_by_part["base"]);
    std::vector<std::unique_ptr<Event>> loads;
    driver_ = make_base_driver(scene_, parts_, loads);
    for (const std::string& line : driver_->description())
        log_.say(line);
    for (auto& event : loads)
        simulation_.add(std::move(event));
    make_cycles_by(&driver_->response());
}

bool Session::resume() {
    const std::vector<fs::path> snapshots = list_snapshots(options_.output);
    for (auto path = snapshots.rbegin(); path != snapshots.rend(); ++path) {
        make_driver(); // its effects are handed their memories
        try {
            Snapshot snapshot = read_snapshot(*path);
            hand_over(snapshot, simulation_.events());
            simulation_.resume(std::move(snapshot.state));
            record_ = std::move(snapshot.record);
            for (const auto& [part, seconds] : record_.seconds_by_part)
                seconds_before_ += seconds;
            kept_ = *path;
            restore_files();
            log_.say(fmt::format("resuming at {} of extension from {}",
                                 length_text(extension(), scene_.output.interval), path->string()));
            return true;
        } catch (const StorageError& error) {
            log_.say(std::string("warning: skipped: ") + error.what());
        }
    }
    return false;
}

/// Puts in place what the folder of a run that goes on must have, though its last session was
/// killed in between.
void Session::restore_files() {
    const fs::path& output = options_.output;
    const MomentNames moments = names();
    const std::vector<fs::path> ended = ended_windows(output, moments, extension());
    history_ = RunHistory(ended);
    report_.read_moments(ended, history_);
    keep_scene();
    write_text(output / "history.csv", to_csv(record_.history));
    if (scene_.output.series == SeriesFormat::paraview)
        write_paraview(output, simulation_.state(), simulation_.base(), moments,
                       scene_.extension.rate);
    if (is_drawn_at(scene_, extension()) && moments.is_window_end(extension()))
        save_field();
    if (options_.figures)
        figures_ = draw_missing(output, scene_, moments, ended, history_);
}

/// Writes scene.toml, unless it is there and says the same.
void Session::keep_scene() const {
    const fs::path file = options_.output / "scene.toml";
    if (scene_lines(read_text_if_there(file)) != scene_lines(record_.scene))
        write_text(file, record_.scene);
}

void Session::begin() {
    record_.scene = to_toml(scene_);
    keep_scene();
    CycleSpeed speed =
        measure_speed(estimated_discs(scene_), options_.threads, 0.1, parts_.accounts_energy);
    speed.team *= ranks();
    record_.predicted_seconds = speed.busy * predict(scene_, speed).seconds;

    if (scene_.picked_fault)
        log_.say(describe(*scene_.picked_fault, *scene_.detachment));
    for (const std::string& warning : scene_.warnings)
        log_.say("warning: " + warning);
    write_status("genesis");
    make_driver();
    State state;
    {
        const Stopwatch watch(record_.seconds_by_part["genesis"]);
        state = make_or_recall_hanging_wall(scene_, parts_, log_, options_.stop, options_.threads);
    }
    if (driver_)
        settle_on_base(state);
    simulation_.begin(std::move(state));
    log_.say(fmt::format("hanging wall: {} discs", simulation_.state().discs.rows()));
    append_history();
    save();
}

/// Puts the hanging wall on the base that deforms.
void Session::settle_on_base(State& state) {
    const Stopwatch watch(record_.seconds_by_part["base"]);
    driver_->settle(state, simulation_.base(), simulation_.physics(), execution(),
                    [&](std::string_view stage, double share) {
                        if (options_.stop.requested())
                            throw Interrupted{};
                        log_.progress(fmt::format("{} ({:.0f} %)", stage, 100.0 * share));
                    });
}

/// Tells how far an event is that takes long. A stop request waits some seconds for its end, since
/// what was made after the last snapshot is lost without it.
void Session::report_step(const std::string& done, std::optional<SteadyClock::time_point>& asked) {
    constexpr double patience = 3.0; // s
    log_.progress(fmt::format("extension {:.2f} km: {}", extension() / 1e3, done));
    if (!options_.stop.requested())
        return;
    if (!asked)
        asked = SteadyClock::now();
    if (seconds_since(*asked) < patience)
        return;
    log_.say(fmt::format("stopped within an event ({}); what came after {} will be made again",
                         done, kept_.string()));
    write_status("stopped");
    throw Interrupted{};
}

void Session::extend() {
    simulation_.report_steps_to([this, asked = std::optional<SteadyClock::time_point>()](
                                    const std::string& done) mutable { report_step(done, asked); });
    const double tolerance = simulation_.tolerance();
    const double steps_before = record_.disc_steps;
    double next_window = next_window_end();
    write_status("extension");
    while (extension() < target() - tolerance) {
        if (options_.stop.requested()) {
            save();
            write_status("stopped");
            throw Interrupted{};
        }
        simulation_.extend_to(std::min(next_window, target()), execution(),
                              [&](const Simulation& s) {
                                  record_.disc_steps = steps_before + s.disc_steps();
                                  report_progress(s);
                                  return !options_.stop.requested();
                              });
        if (extension() < next_window - tolerance)
            continue;
        next_window = next_window_end();
        end_window();
    }
}

/// The first multiple of the interval that has not been reached; windows shorter than a cycle are
/// passed over. Windows are counted, not summed up, so that a resumed run has the same ends.
double Session::next_window_end() const {
    const double window = scene_.output.interval, tolerance = simulation_.tolerance();
    double count = std::floor((extension() + tolerance) / window);
    while (extension() >= count * window - tolerance)
        count += 1.0;
    return count * window;
}

void Session::end_window() {
    {
        const Stopwatch watch(record_.seconds_by_part["measures"]);
        append_history();
    }
    const bool drawn = is_drawn_at(scene_, extension());
    if (drawn && options_.figures)
        faults_now(); // for the report, too
    save();
    if (drawn) { // beside the cycles that follow
        draw();
        save_field();
    }
    report_.write_live(to_csv(record_.history));
    write_status("extension");
}

void Session::report_progress(const Simulation& simulation) {
    const double share = std::max(1e-3, extension() / target());
    const double cycling = std::max(1e-9, record_.seconds_by_part["cycle"]);
    log_.progress(fmt::format("cycle {}  extension {}  {:.1f} M disc-steps/s  {} left",
                              simulation.state().clock.cycle, way_text(extension(), target()),
                              record_.disc_steps / cycling / 1e6,
                              rough_duration(wall_seconds() / share * (1.0 - share))));
}

Observation Session::now() const {
    return {scene_, parts_, simulation_.state(), simulation_.events()};
}

Measures Session::measure_now() const {
    return measure(setting_, simulation_.state(), parts_.base, simulation_.events());
}

const FaultReport& Session::faults_now() {
    if (!faults_ || faults_at_ != extension()) {
        const Stopwatch watch(record_.seconds_by_part["measures"]);
        faults_ = report_faults(setting_, parts_.base, simulation_.state(), history_);
        faults_at_ = extension();
    }
    return *faults_;
}

/// Says once what makes the results doubtful, when a whole window of strain is known or at the end.
void Session::warn_of_haste(const Measures& measures) {
    const double known = std::min(strain_window, target()) - simulation_.tolerance();
    if (has_warned_ || measures.quasi_static.value_or(true) || extension() < known)
        return;
    has_warned_ = true;
    log_.say(fmt::format(
        "warning: too fast to be quasi-static: unbalanced forces are {:.2g} of contact forces "
        "(at most {:g}), the inertial number is {:.2g} (at most {:g}); a smaller "
        "extension.speed_m_per_s than {:g} is needed, or more discs",
        measures.unbalanced_ratio_mean, greatest_unbalanced_ratio, measures.inertial_number,
        greatest_inertial_number, scene_.extension.speed));
}

void Session::append_history() {
    const Measures measures = measure_now();
    warn_of_haste(measures);
    NamedNumbers row = history_row(simulation_.state(), measures);
    append(row, measure_effects(now()).numbers);
    std::optional<std::string> beyond_elasticity;
    if (driver_) {
        const BaseWindow window = driver_->end_window(simulation_.state(), simulation_.base());
        append(row, window.measures);
        beyond_elasticity = window.beyond_elasticity;
    }
    Table& history = record_.history;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [name, value] : row)
        history.add<double>(name, "", nan);
    history.resize(history.rows() + 1);
    for (const auto& [name, value] : row)
        history.get<double>(name).back() = value;
    write_text(options_.output / "history.csv", to_csv(history));
    if (beyond_elasticity)
        throw BeyondElasticity(*beyond_elasticity);
}

void Session::save() {
    const MomentNames moments = names();
    const bool ends_window = moments.is_window_end(extension());
    if (ends_window)
        report_window();
    const Stopwatch watch(record_.seconds_by_part["output"]);
    const State& state = simulation_.state();
    kept_ = snapshot_path(options_.output, moments, extension());
    write_snapshot(kept_, state, simulation_.events(), record_);
    remove_passed_stops(options_.output, moments, extension());
    if (ends_window)
        history_.add(DiscPlaces(state));
    if (scene_.output.series == SeriesFormat::paraview)
        write_paraview(options_.output, state, simulation_.base(), moments, scene_.extension.rate);
}

/// What the report shows of this moment; faults are followed back where they are known.
void Session::report_window() {
    const bool followed = faults_ && faults_at_ == extension();
    if (!report_.is_wanted() || report_.has(extension(), followed))
        return;
    const Stopwatch watch(record_.seconds_by_part["report"]);
    if (followed)
        report_.add(now(), *faults_, stress_below());
    else
        report_.add(now(), history_);
}

/// The stress below the base; none where it is not known.
std::vector<fem::StressPatch> Session::stress_below() {
    const fem::Footwall* footwall = driver_ ? driver_->recover(simulation_.state()) : nullptr;
    return footwall ? footwall->stress() : std::vector<fem::StressPatch>();
}

void Session::write_status(const std::string& phase) const {
    const double share = std::max(1e-3, extension() / target());
    const double left = phase == "finished" ? 0.0
                        : extension() > 0.0 ? std::max(0.0, wall_seconds() / share * (1.0 - share))
                                            : record_.predicted_seconds;
    write_object(options_.output / "status.json",
                 {{"phase", phase},
                  {"extension_m", extension()},
                  {"of_m", target()},
                  {"seconds_left", static_cast<std::int64_t>(left + 0.5)}});
}

/// The field below the discs: at the figures' moments, for a file of it is larger than the discs'.
void Session::save_field() {
    if (!driver_ || scene_.output.series != SeriesFormat::paraview)
        return;
    const Stopwatch watch(record_.seconds_by_part["output"]);
    if (const fem::Footwall* footwall = driver_->recover(simulation_.state()))
        write_footwall(options_.output, *footwall, extension(), names(), scene_.extension.rate);
}

void Session::draw() {
    if (!options_.figures)
        return;
    const FaultReport& faults = faults_now();
    const Stopwatch watch(record_.seconds_by_part["figures"]);
    drawn_at_ = extension();
    figures_.push_back(draw_figures(now(), faults, options_.output / "figures", names()));
}

/// The moments of the experiment on one sheet. Returns what is wrong.
std::string Session::draw_sheet() const {
    try {
        const RunFolder run(options_.output, scene_);
        if (parts_.base_moves)
            draw_base(run, {.provenance = provenance(scene_)});
        draw_experiment(run, history_);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

void Session::await_figures() {
    const Stopwatch watch(record_.seconds_by_part["figures"]);
    for (std::future<std::string>& figure : figures_)
        if (const std::string problem = figure.get(); !problem.empty())
            log_.say("warning: no figures: " + problem);
    figures_.clear();
}

/// Solves for the base once more on a finer mesh.
void Session::check_base() {
    if (!driver_)
        return;
    const Stopwatch watch(record_.seconds_by_part["base"]);
    if (const std::optional<BaseCheck> check = driver_->check(simulation_.state())) {
        base_check_ = check->measures;
        log_.say(check->line);
    }
}

/// What summary.json has besides the measures of this moment.
NamedNumbers Session::summary_numbers(const NamedNumbers& of_effects) const {
    NamedNumbers numbers = of_effects;
    for (const EffectPart& part : scene_.effects)
        if (part.effect->summarise)
            append(numbers, part.effect->summarise(record_.history, simulation_.state()));
    append(numbers, base_check_);
    if (scene_.picked_fault)
        add(numbers, "detachment_misfit_m", scene_.picked_fault->misfit);
    return numbers;
}

/// Picked horizons beside the model's, each said in a line.
std::vector<ObservedHorizon> Session::compare_with_observed(const FaultReport& faults) {
    if (!scene_.observed)
        return {};
    const Stopwatch watch(record_.seconds_by_part["measures"]);
    std::vector<ObservedHorizon> rows =
        compare_horizons(scene_, simulation_.state(),
                         trace_horizons(setting_, parts_.base, simulation_.state(), faults.faults));
    for (const ObservedHorizon& row : rows)
        log_.say(row.misfit
                     ? fmt::format("observed {}: {:.0f} m off in the mean, at most {:.0f} m at x = "
                                   "{:.2f} km; {} of {} points beside the top of stratum {}",
                                   row.name, row.misfit->mean, row.misfit->largest,
                                   row.misfit->worst.x / 1e3, row.misfit->compared, row.points,
                                   *row.stratum)
                     : fmt::format("warning: observed {} {}", row.name, row.objection));
    return rows;
}

void Session::finish() {
    const fs::path& output = options_.output;
    if (drawn_at_ != extension())
        draw();
    const FaultReport& faults = faults_now();
    if (kept_ != snapshot_path(output, names(), extension()))
        save();
    remove_passed_stops(output, names(), extension());
    const auto check_stop = [&] { // all is kept: resumed, the run ends from here
        if (!options_.stop.requested())
            return;
        write_status("stopped");
        throw Interrupted{};
    };
    check_stop();
    report_window();
    check_base(); // before the sheet, which solves for the base: that is for one thread at a time
    if (options_.figures)
        figures_.push_back(std::async(std::launch::async, [this] { return draw_sheet(); }));
    const Measures measures = measure_now();
    warn_of_haste(measures);
    const EffectMeasures of_effects = measure_effects(now());
    const std::vector<ObservedHorizon> observed = compare_with_observed(faults);
    await_figures();
    check_stop();
    const std::string summary = summary_json({.scene = scene_.name,
                                              .accuracy = scene_.accuracy,
                                              .seed = scene_.seed,
                                              .threads = options_.threads,
                                              .ranks = ranks(),
                                              .cycle = std::string(name(execution().cycle)),
                                              .state = simulation_.state(),
                                              .record = record_,
                                              .measures = measures,
                                              .faults = faults,
                                              .effects = effect_names(scene_),
                                              .numbers = summary_numbers(of_effects.numbers),
                                              .objects = of_effects.groups,
                                              .lists = of_effects.lists,
                                              .observed = observed,
                                              .wall_seconds = wall_seconds(),
                                              .state_hash = simulation_.hash(),
                                              .provenance = provenance(scene_)});
    write_text(output / "summary.json", summary);
    report_.write(to_csv(record_.history), summary);
    write_status("finished");
    log_.say(fmt::format("done: {} of extension in {}, figures in {}", length_text(extension()),
                         rough_duration(wall_seconds()), (output / "figures").string()));
}

} // namespace listric
