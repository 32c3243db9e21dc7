#include "apps/run/run.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/archive/summary.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/figures.hpp"
#include "apps/figures/paraview.hpp"
#include "apps/measures/fault_history.hpp"
#include "apps/measures/measure.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/footwall_coupling.hpp"
#include "apps/run/flexure.hpp"
#include "apps/run/prediction.hpp"
#include "apps/support/log.hpp"
#include "apps/support/memory.hpp"
#include "apps/support/version.hpp"
#include "dem/contacts.hpp"
#include "dem/cycle.hpp"
#include "dem/events/energy_account.hpp"
#include "dem/events/strain.hpp"
#include "dem/genesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <sys/file.h>
#include <unistd.h>

namespace listric {

using namespace dem;
using namespace coupling;

namespace {

namespace fs = std::filesystem;

/// A run in progress.
struct Run {
    const Scene& scene;
    const RunOptions& options;
    RigidBase base;
    CyclePhysics physics;
    std::vector<std::unique_ptr<Event>> events;
    std::unique_ptr<FootwallCoupling> footwall; ///< none: the base does not respond
    std::unique_ptr<BaseMotion> base_motion;    ///< none: it is not prescribed
    EnergyAccount* energy = nullptr;            ///< one of the events, if it is on
    State state;
    RunRecord record;
    SteadyClock::time_point started = SteadyClock::now();
    double seconds_before = 0.0; ///< wall time of the sessions that this one resumes
    fs::path kept;               ///< snapshot of the present state, if there is one
    double drawn_at = -1.0;      ///< extension of the last figures, m
    bool warned = false;         ///< that the run is too fast

    explicit Run(const Scene& s, const RunOptions& o)
        : scene(s), options(o),
          base(make_base(s)), physics{s.cycle.damping, s.gravity ? s.gravity->acceleration : 0.0},
          events(make_events(s)) {
        if (s.elastic_base && s.elastic_base->relative_damping)
            physics.averaging_time = s.elastic_base->averaging_time;
        if (s.base_motion)
            base_motion =
                std::make_unique<BaseMotion>(*s.base_motion, base.motion, s.extension.rate);
        for (const auto& event : events)
            if (auto* account = dynamic_cast<EnergyAccount*>(event.get()))
                energy = account;
    }

    double wall_seconds() const { return seconds_before + seconds_since(started); }
    double target() const {
        return std::min(scene.extension.distance, options.until.value_or(1e300));
    }
    /// Half a cycle's extension: events are due in the cycle nearest to their extension.
    double tolerance() const { return 0.5 * scene.extension.speed * state.clock.time_step; }
};

std::string time_left(double seconds) {
    const auto s = static_cast<long>(seconds);
    if (s < 90)
        return fmt::format("{} s", s);
    if (s < 5400)
        return fmt::format("{} min", (s + 30) / 60);
    return fmt::format("{:.1f} h", static_cast<double>(s) / 3600.0);
}

fs::path snapshot_path(const fs::path& output, const State& state) {
    return output / "snapshots" / fmt::format("extension-{:08.2f}m.h5", state.clock.extension);
}

/// Genesis is the same for every scene with the same hanging wall, so it is kept.
fs::path cache_path(const Scene& scene) {
    Scene start = scene;
    start.accuracy = start.description = start.name = "";
    start.extension = {};
    start.output = {};
    start.extension.distance = scene.extension.distance; // decides how far the base reaches
    start.fault_weakening.reset();
    start.bond_healing.reset();
    start.sedimentation.reset();
    start.compaction.reset();
    start.elastic_base.reset();
    start.lower_crust_thinning.reset();
    start.basin_water.reset();
    start.footwall_erosion.reset();
    start.base_motion.reset();
    start.energy.reset();
    std::uint64_t key = 1469598103934665603u; // FNV-1a
    const auto stir = [&](std::string_view text) {
        for (char letter : text)
            key = (key ^ static_cast<unsigned char>(letter)) * 1099511628211u;
    };
    stir(to_toml(start));
    // The time step is that of the stiffest material, also of those that discs become later.
    stir(fmt::format("{}", stable_time_step(1.0, make_materials(scene), 0.0, 1.0)));
    stir(source_hash);
    stir(compiler);
    stir(build_flags);
    stir(instruction_set);
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const fs::path folder = cache && *cache ? fs::path(cache)
                            : home && *home ? fs::path(home) / ".cache"
                                            : fs::temp_directory_path();
    return folder / "listric" / fmt::format("genesis-{:016x}.h5", key);
}

State make_state(Run& run, Log& log) {
    const Stopwatch watch(run.record.seconds_by_part["genesis"]);
    const fs::path cache = cache_path(run.scene);
    std::error_code ignored;
    if (fs::exists(cache, ignored)) {
        try {
            State state = read_snapshot(cache).state;
            state.materials = make_materials(run.scene);
            log.say("hanging wall: kept from an earlier run, " + cache.string());
            return state;
        } catch (const StorageError& error) {
            log.say(std::string("warning: the kept hanging wall is made anew: ") + error.what());
        }
    }
    const Scene& s = run.scene;
    const GenesisRequest request{*s.hanging_wall,
                                 run.base,
                                 make_materials(s),
                                 s.bonds,
                                 {s.cycle.damping, run.physics.gravity},
                                 s.cycle.time_step_safety,
                                 s.cycle.inertial_mass_floor,
                                 s.cycle.skin,
                                 s.seed};
    State state = make_hanging_wall(request, [&](std::string_view stage, double share) {
        run.options.stop.check();
        log.progress(fmt::format("hanging wall: {} ({:.0f} %)", stage, 100.0 * share));
    });
    try {
        fs::create_directories(cache.parent_path());
        write_snapshot(cache, state, {}, {});
    } catch (const std::exception& error) {
        log.say(std::string("warning: the hanging wall cannot be kept for later runs: ") +
                error.what());
    }
    return state;
}

/// Condenses the footwall of a scene that has one.
void make_footwall(Run& run, Log& log) {
    if (!run.scene.elastic_base)
        return;
    const Stopwatch watch(run.record.seconds_by_part["base"]);
    run.footwall = std::make_unique<FootwallCoupling>(run.scene);
    for (const std::string& line : run.footwall->description())
        log.say(line);
    std::ranges::move(run.footwall->make_events(), std::back_inserter(run.events));
}

/// Gives a detachment whose motion is prescribed the nodes that it moves by.
void attach_base_motion(Run& run) {
    constexpr double face = 1000.0; // m: arcs are followed to millimetres
    const auto nodes = detachment_nodes(run.base.surfaces.front().chain, face);
    std::vector<double> x, y;
    for (const Point& node : nodes) {
        x.push_back(node.x);
        y.push_back(node.y);
    }
    add_base_nodes(run.state, x, y);
}

Execution execution(const Run& run) {
    return {run.options.threads, run.options.plain ? Cycle::plain : Cycle::best};
}

/// Puts the hanging wall on the elastic base and settles it there.
void settle_on_base(Run& run, Log& log) {
    const Stopwatch watch(run.record.seconds_by_part["base"]);
    ElasticBase& base = run.footwall->base();
    base.attach(run.state);
    find_contacts(run.state, run.base);
    base.settle(run.state, run.base, run.physics, execution(run),
                [&](std::string_view stage, double share) {
                    run.options.stop.check();
                    log.progress(fmt::format("{} ({:.0f} %)", stage, 100.0 * share));
                });
    if (run.physics.averaging_time > 0.0)
        add_mean_velocities(run.state);
}

void begin(Run& run, Log& log) {
    if (!run.footwall)
        make_footwall(run, log);
    run.state = make_state(run, log);
    if (run.footwall)
        settle_on_base(run, log);
    if (run.base_motion)
        attach_base_motion(run);
    for (auto& event : run.events)
        event->begin(run.state);
    find_contacts(run.state, run.base);
    if (run.energy)
        run.energy->open(run.state, run.base);
    log.say(fmt::format("hanging wall: {} discs", run.state.discs.rows()));
}

/// Continues from the newest snapshot that can be read. False if there is none.
bool restore(Run& run, Log& log) {
    std::vector<fs::path> snapshots = list_snapshots(run.options.output);
    for (auto path = snapshots.rbegin(); path != snapshots.rend(); ++path) {
        if (!run.footwall)
            make_footwall(run, log); // its effects are handed their memories
        try {
            Snapshot snapshot = read_snapshot(*path);
            hand_over(snapshot, run.events);
            run.state = std::move(snapshot.state);
            run.record = std::move(snapshot.record);
            for (const auto& [part, seconds] : run.record.seconds_by_part)
                run.seconds_before += seconds;
            run.kept = *path;
            log.say(fmt::format("resuming at {:.2f} m of extension from {}",
                                run.state.clock.extension, path->string()));
            return true;
        } catch (const StorageError& error) {
            log.say(std::string("warning: skipped: ") + error.what());
        }
    }
    return false;
}

double next_due(const Run& run) {
    double due = std::numeric_limits<double>::infinity();
    for (const auto& event : run.events)
        due = std::min(due, static_cast<double>(event->applied + 1) * event->schedule().spacing());
    return due;
}

void apply_due_events(Run& run) {
    bool search_due = false;
    const auto search = [&] {
        const Stopwatch watch(run.record.seconds_by_part["rebuild"]);
        find_contacts(run.state, run.base);
        search_due = false;
    };
    const auto account = [&](auto&& book) {
        if (!run.energy)
            return;
        if (search_due)
            search(); // contacts that an event has made hold energy
        const Stopwatch watch(run.record.seconds_by_part[run.energy->name()]);
        book(*run.energy);
    };
    account([&](EnergyAccount& energy) { energy.book_cycles(run.state, run.base); });
    for (auto& event : run.events)
        if (static_cast<double>(event->applied + 1) * event->schedule().spacing() <=
            run.state.clock.extension + run.tolerance()) {
            {
                const Stopwatch watch(run.record.seconds_by_part[event->name()]);
                search_due |= event->apply(run.state, run.base);
                ++event->applied;
            }
            account([&](EnergyAccount& energy) {
                energy.book_event(event->name(), run.state, run.base);
            });
        }
    if (search_due)
        search();
}

/// Cycles toward the given extension for a fraction of a second.
void cycle_toward(Run& run, double extension) {
    const Stopwatch watch(run.record.seconds_by_part["cycle"]);
    const double per_cycle = run.scene.extension.speed * run.state.clock.time_step;
    const double wanted = (extension - run.state.clock.extension) / per_cycle;
    const auto discs = static_cast<double>(run.state.discs.rows());
    const auto batch = static_cast<std::int64_t>(
        std::clamp(std::floor(wanted), 1.0, std::max(1.0, std::floor(2e7 / discs))));
    ElasticBase* const base = run.footwall ? &run.footwall->base() : nullptr;
    const double before = base ? base->seconds : 0.0;
    BaseResponse* const response = base ? static_cast<BaseResponse*>(base) : run.base_motion.get();
    Execution how = execution(run);
    EnergyFlows flows;
    if (run.energy) {
        flows = run.energy->flows();
        how.energy = &flows;
    }
    if (base && base->is_iterated())
        base->advance_iterated(run.state, run.base, run.physics, batch, how);
    else
        advance(run.state, run.base, run.physics, batch, how, response);
    if (run.energy)
        run.energy->put(flows);
    if (base) {
        run.record.seconds_by_part["base"] += base->seconds - before;
        run.record.seconds_by_part["cycle"] -= base->seconds - before;
    }
    run.record.disc_steps += discs * static_cast<double>(batch);
}

/// Says once what makes the results doubtful, when a whole window of strain is known or at the
/// end.
void warn_of_haste(Run& run, const Measures& measures, Log& log) {
    const double known = std::min(strain_window, run.target()) - run.tolerance();
    if (run.warned || measures.quasi_static.value_or(true) || run.state.clock.extension < known)
        return;
    run.warned = true;
    log.say(fmt::format(
        "warning: too fast to be quasi-static: unbalanced forces are {:.2g} of contact forces "
        "(at most {:g}), the inertial number is {:.2g} (at most {:g}); a smaller "
        "extension.speed_m_per_s than {:g} is needed, or more discs",
        measures.unbalanced_ratio_mean, greatest_unbalanced_ratio, measures.inertial_number,
        greatest_inertial_number, run.scene.extension.speed));
}

void append_history(Run& run, Log& log) {
    const Measures measures = measure(run.scene, run.state, run.base, run.events);
    warn_of_haste(run, measures, log);
    auto row = history_row(run.state, measures);
    if (run.footwall)
        std::ranges::move(run.footwall->end_window(run.state, run.base), std::back_inserter(row));
    Table& history = run.record.history;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [name, value] : row)
        history.add<double>(name, "", nan);
    history.resize(history.rows() + 1);
    for (const auto& [name, value] : row)
        history.get<double>(name).back() = value;
    write_text(run.options.output / "history.csv", to_csv(history));
}

void save(Run& run) {
    const Stopwatch watch(run.record.seconds_by_part["output"]);
    run.kept = snapshot_path(run.options.output, run.state);
    write_snapshot(run.kept, run.state, run.events, run.record);
    if (run.scene.output.series == SeriesFormat::paraview)
        write_paraview(run.options.output, run.state, run.base, run.scene.extension.rate);
}

/// The field below the discs: at the figures' moments, for a file of it is larger than the
/// discs'.
void save_field(Run& run) {
    if (!run.footwall || run.scene.output.series != SeriesFormat::paraview)
        return;
    const Stopwatch watch(run.record.seconds_by_part["output"]);
    run.footwall->write(run.options.output, run.state);
}

FaultReport report_faults(Run& run) {
    const Stopwatch watch(run.record.seconds_by_part["measures"]);
    const std::vector<fs::path> snapshots = list_snapshots(run.options.output);
    return report_faults(run.scene, run.base, run.state, snapshots);
}

void draw(Run& run, Log& log) {
    if (!run.options.figures)
        return;
    const FaultReport faults = report_faults(run);
    const Stopwatch watch(run.record.seconds_by_part["figures"]);
    run.drawn_at = run.state.clock.extension;
    const std::string problem = draw_figures(run.scene, run.state, run.base, run.events, faults,
                                             run.options.output / "figures");
    if (!problem.empty())
        log.say("warning: no figures: " + problem);
}

/// The moments of the experiment on one sheet.
void draw_sheet(Run& run, Log& log) {
    if (!run.options.figures)
        return;
    const Stopwatch watch(run.record.seconds_by_part["figures"]);
    try {
        if (run.footwall || run.base_motion)
            draw_base(run.options.output);
        draw_experiment(run.options.output);
    } catch (const std::exception& error) {
        log.say(std::string("warning: no sheet of figures: ") + error.what());
    }
}

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
    std::string result = "'";
    for (char letter : word)
        result += letter == '\'' ? "'\\''" : std::string(1, letter);
    return result + "'";
}

/// Solves for the base once more on a finer mesh.
void check_base(Run& run, Log& log) {
    if (!run.footwall)
        return;
    const Stopwatch watch(run.record.seconds_by_part["base"]);
    if (const auto fine = run.footwall->check(run.state)) {
        run.record.base_elements_difference = fine->elements;
        run.record.base_resolved_difference = fine->base;
        log.say(fmt::format("the base under the last window's mean forces, solved again with {} "
                            "unknowns: the run's elements are {:.2f} % off, its base {:.2f} %",
                            fine->unknowns, 100.0 * fine->elements, 100.0 * fine->base));
    }
}

/// How to run the scene of a folder.
std::string call_for(const fs::path& output) {
    const char* call = std::getenv("LISTRIC_CALL"); // how the launcher was called
    return fmt::format("{} run {}", call ? call : "listric",
                       quoted((output / "scene.toml").string()));
}

std::string resume_hint(const fs::path& output) {
    return fmt::format("resume with: {} --output {} --resume", call_for(output),
                       quoted(output.string()));
}

std::string last_good(const fs::path& output) {
    const auto snapshots = list_snapshots(output);
    return snapshots.empty() ? "it happened before the first snapshot"
                             : "the last good state is " + snapshots.back().string();
}

/// A run repeats itself to the last bit, so it would fail again: it needs another step, or
/// speed.
std::string retry_hint(const Scene& scene, const fs::path& output) {
    return fmt::format("resumed it would end the same way; a smaller time step or speed may help, "
                       "in a new run: {} --set cycle.time_step_safety={:g} --output {}; if not, "
                       "--set extension.speed_m_per_s={:g}",
                       call_for(output), 0.5 * scene.cycle.time_step_safety,
                       quoted(output.string() + "-2"), 0.5 * scene.extension.speed);
}

void report(Run& run, Log& log) {
    const double done = run.state.clock.extension / run.target();
    const double spent = run.wall_seconds();
    const double cycling = std::max(1e-9, run.record.seconds_by_part["cycle"]);
    const double share = std::max(1e-3, done);
    log.progress(fmt::format(
        "cycle {}  extension {:.2f} of {:.2f} km  {:.1f} M disc-steps/s  {} left",
        run.state.clock.cycle, run.state.clock.extension / 1e3, run.target() / 1e3,
        run.record.disc_steps / cycling / 1e6, time_left(spent / share * (1.0 - share))));
}

bool near_any(const std::vector<double>& marks, double extension, double tolerance) {
    return std::ranges::any_of(
        marks, [&](double mark) { return std::abs(mark - extension) <= tolerance; });
}

/// Cycles and events up to the target. Throws Interrupted after saving.
void march(Run& run, Log& log) {
    State& state = run.state;
    const double window = run.scene.output.interval;
    double next_window =
        (std::floor((state.clock.extension + run.tolerance()) / window) + 1.0) * window;
    while (state.clock.extension < run.target() - run.tolerance()) {
        if (run.options.stop.requested()) {
            save(run);
            throw Interrupted{};
        }
        const double stop = std::min({next_due(run), next_window, run.target()});
        cycle_toward(run, stop);
        report(run, log);
        if (state.clock.extension < stop - run.tolerance())
            continue;
        apply_due_events(run);
        if (state.clock.extension < next_window - run.tolerance())
            continue;
        next_window += window;
        {
            const Stopwatch watch(run.record.seconds_by_part["measures"]);
            append_history(run, log);
        }
        if (near_any(run.scene.output.figures, state.clock.extension, 0.5 * window)) {
            draw(run, log);
            save_field(run);
        }
        save(run);
    }
}

/// Keeps other runs out of the output folder while it lives.
class Lock {
public:
    explicit Lock(const fs::path& output)
        : file_(open((output / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
        if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(file_);
            throw UsageError(output.string() + ": another run is writing there");
        }
    }
    ~Lock() {
        if (file_ >= 0)
            close(file_);
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    int file_;
};

bool holds_run(const fs::path& output) {
    std::error_code error;
    return fs::exists(output / "scene.toml", error) || fs::exists(output / "summary.json", error);
}

/// Removes the files of a folder for which `ours` is true of the name.
template <class Ours> void remove_files(const fs::path& folder, Ours&& ours) {
    std::error_code error;
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (ours(entry.path().filename().string()))
            found.push_back(entry.path());
    for (const fs::path& path : found)
        fs::remove_all(path, error);
}

/// What a session that was killed left half done.
void remove_remains(const fs::path& output) {
    const auto half_written = [](const std::string& name) {
        // name.PID.part, as write_text and write_snapshot make them
        const std::size_t end = name.size() >= 5 && name.ends_with(".part") ? name.size() - 5 : 0;
        const std::size_t dot = end ? name.rfind('.', end - 1) : name.npos;
        return dot != name.npos && dot > 0 && end > dot + 1 &&
               std::ranges::all_of(name.substr(dot + 1, end - dot - 1),
                                   [](char c) { return c >= '0' && c <= '9'; });
    };
    for (const fs::path& folder : {output, output / "snapshots", output / "paraview"})
        remove_files(folder, half_written);
    remove_files(output / "figures", [](const std::string& name) {
        return name.starts_with(".data-") || (name.starts_with(".") && name.ends_with(".tmp"));
    });
}

/// Removes a run's own files, and nothing else that may be in the folder.
void remove_run(const fs::path& output) {
    const auto ends = [](const char* ending) {
        return [ending](const std::string& name) { return name.ends_with(ending); };
    };
    remove_files(output / "snapshots", ends(".h5"));
    remove_files(output / "paraview", ends(".vtp"));
    remove_files(output / "paraview", ends(".vtu"));
    remove_files(output / "figures", ends("km.png"));
    remove_files(output / "figures", ends("km.gif"));
    remove_files(output / "figures", ends("km.mp4"));
    std::error_code error;
    for (const char* file :
         {"summary.json", "history.csv", "paraview.pvd", "log.txt", "scene.toml", "deflection.csv",
          "base.csv", "figures/base.png", "footwall.pvd", "footwall.vtu", "figures/flexure.png"})
        fs::remove(output / file, error);
}

/// A line of a scene without its comment.
std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const char c = line[k];
        if (quote == '"' && c == '\\')
            ++k;
        else if (quote)
            quote = c == quote ? 0 : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '#') {
            line = line.substr(0, k);
            break;
        }
    }
    return line.substr(0, line.find_last_not_of(' ') + 1);
}

/// A resumed run must be the same run; comments may have changed with the program.
void check_same_scene(const Scene& scene, const fs::path& file) {
    std::ifstream in(file);
    const std::string before(std::istreambuf_iterator<char>(in), {});
    const std::string now = to_toml(scene);
    if (before.empty())
        return;
    std::string_view a = before, b = now;
    const auto next_line = [](std::string_view& text) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return without_comment(line);
    };
    std::string_view line_a, line_b;
    while (line_a == line_b && (!a.empty() || !b.empty())) {
        line_a = next_line(a);
        line_b = next_line(b);
    }
    if (line_a == line_b)
        return;
    throw UsageError(fmt::format("{}: the run to resume has other parameters: it has \"{}\", this "
                                 "call \"{}\"; resume it with "
                                 "the parameters that it began with, or start anew with --force",
                                 file.string(), line_a, line_b));
}

/// Refuses a folder that holds something else than what is asked for, before any work is done.
/// True if the run to resume has reached its end already.
bool check_output(const Scene& scene, const RunOptions& options) {
    const fs::path& output = options.output;
    const fs::path summary = output / "summary.json";
    std::error_code error;
    if (!holds_run(output) || options.force)
        return false;
    if (!options.resume)
        throw UsageError(output.string() + " holds " +
                         (fs::exists(summary, error) ? "a finished run" : "an unfinished run") +
                         ": --resume continues it, --force replaces it, --output writes elsewhere");
    check_same_scene(scene, output / "scene.toml");
    const auto reached = summary_extension(summary);
    if (scene.flexure)
        return reached.has_value();
    const double target = std::min(scene.extension.distance, options.until.value_or(1e300));
    return reached && *reached >= target - 0.5;
}

/// Makes the output folder ready for this run.
void prepare_output(const Scene& scene, const RunOptions& options) {
    const fs::path& output = options.output;
    std::error_code error;
    if (options.force && holds_run(output))
        remove_run(output);
    fs::create_directories(scene.flexure ? output : output / "snapshots", error);
    if (error)
        throw StorageError(output.string() + ": cannot make the output folder: " + error.message());
    remove_remains(output);
    write_text(output / ".write-test", "x");
    fs::remove(output / ".write-test", error);
    fs::remove(output / "summary.json", error); // of a run that now goes on
}

} // namespace

RunOutcome run_scene(const Scene& scene, const RunOptions& options) {
    if (check_output(scene, options))
        return RunOutcome::finished;
    const fs::path& output = options.output;
    std::error_code error;
    fs::create_directories(output, error);
    const Lock lock(output);
    prepare_output(scene, options);

    Log log(output / "log.txt", options.quiet);
    log.say(fmt::format("listric {} runs {} ({}, seed {}) into {}", version, scene.name,
                        scene.accuracy, scene.seed, output.string()));
    if (scene.flexure) {
        write_text(output / "scene.toml", to_toml(scene));
        bend_base(scene, options.threads, output, [&](const std::string& text) { log.say(text); });
        return RunOutcome::finished;
    }
    note_memory_need(predict(scene, 1.0, options.threads).memory);
    Run run(scene, options);
    try {
        if (!options.resume || !restore(run, log)) {
            const std::string text = to_toml(scene);
            write_text(output / "scene.toml", text);
            run.record.scene = text;
            const CycleSpeed speed = measure_speed(estimated_discs(scene), options.threads, 0.3,
                                                   scene.energy.has_value());
            run.record.predicted_seconds =
                speed.busy * predict(scene, speed.disc_steps_per_second, options.threads).seconds;
            begin(run, log);
            append_history(run, log);
            save(run);
        }
        march(run, log);
        if (run.drawn_at != run.state.clock.extension)
            draw(run, log);
        if (run.kept != snapshot_path(output, run.state))
            save(run);
        draw_sheet(run, log);
        const Measures measures = measure(scene, run.state, run.base, run.events);
        warn_of_haste(run, measures, log);
        const FaultReport faults = report_faults(run);
        check_base(run, log);
        write_text(output / "summary.json",
                   summary_json(scene, options.threads, run.state, run.record, measures, faults,
                                run.wall_seconds(), run_hash(run.state, run.events)));
        log.say(fmt::format("done: {:.2f} km of extension in {}, figures in {}",
                            run.state.clock.extension / 1e3, time_left(run.wall_seconds()),
                            (output / "figures").string()));
        return RunOutcome::finished;
    } catch (const Interrupted&) {
        log.say("stopped at " + fmt::format("{:.2f}", run.state.clock.extension) +
                " m of extension; " + resume_hint(output));
        return RunOutcome::interrupted;
    } catch (const BeyondElasticity& limit) {
        throw NumericalFailure(fmt::format("{}\n{}, and valid", limit.what(), last_good(output)));
    } catch (const NumericalFailure& failure) {
        throw NumericalFailure(fmt::format("{}\n{}; {}", failure.what(), last_good(output),
                                           retry_hint(scene, output)));
    } catch (const StorageError& failure) {
        const auto snapshots = list_snapshots(output);
        if (snapshots.empty())
            throw;
        throw StorageError(
            fmt::format("{}\nthe last good state is {}; once files can be written, {}",
                        failure.what(), snapshots.back().string(), resume_hint(output)));
    }
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
            if (path == snapshots.back() || near_any(scene.output.figures, snapshot_extension(path),
                                                     0.5 * scene.output.interval))
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
