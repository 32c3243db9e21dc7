#include "apps/run/session.hpp"

#include "apps/archive/run_folder.hpp"
#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "apps/run/hints.hpp"
#include "apps/run/prediction.hpp"
#include "apps/scene/scene_file.hpp"
#include "coupling/strong_scheme.hpp"
#include "dem/contacts.hpp"
#include "dem/ranked_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace listric {

using namespace archive;
using namespace dem;
using namespace coupling;

namespace {

/// Gives a base that is driven the nodes that it moves by.
void attach(const std::vector<Point>& nodes, State& state) {
    std::vector<double> x, y;
    for (const Point& node : nodes) {
        x.push_back(node.x);
        y.push_back(node.y);
    }
    add_base_nodes(state, x, y);
}

} // namespace

Session::Session(const Scene& scene, const RunOptions& options, Log& log, OutputList outputs)
    : run_(scene, options, log, simulation_), simulation_(run_.parts.base, run_.parts.physics),
      driver_(make_base_driver(scene, run_.parts)) {
    for (auto& event : make_events(scene, run_.parts))
        simulation_.add(std::move(event));
    simulation_.report_times_to([this](const std::string& part, double seconds) {
        const double base = footwall_ ? std::exchange(footwall_->base().seconds, 0.0) : 0.0;
        run_.record.seconds_by_part[part] += seconds - base;
        if (base > 0.0)
            run_.record.seconds_by_part[name(Part::base)] += base;
    });
    make_cycles_by(driver_.response.get());
    for (const MakeOutput make : outputs)
        if (auto output = make(run_))
            outputs_.push_back(std::move(output));
}

RunOutcome Session::run() {
    try {
        if (!run_.options.resume || !resume())
            begin();
        extend();
        finish();
        return RunOutcome::finished;
    } catch (const Interrupted&) {
        enter(Phase::stopped);
        run_.log.say(fmt::format("stopped at {} of extension; {}",
                                 length_text(run_.extension(), run_.scene.output.interval),
                                 resume_hint(run_.options.output)));
        return RunOutcome::interrupted;
    }
}

void Session::tell(Hook hook) {
    for (const auto& output : outputs_) {
        const PartWatch time = run_.watch(output->part());
        ((*output).*hook)(run_);
    }
}

void Session::enter(Phase phase) {
    run_.phase = phase;
    tell(&Output::enter);
}

/// Cycles are made here, or on all ranks.
/// @param response  of the base; none: nothing answers to its loads
void Session::make_cycles_by(BaseResponse* response) {
    if (RankedCycles* const on_ranks = run_.options.on_ranks)
        simulation_.advance_by(
            [on_ranks, response](State& state, const RigidBase&, const CyclePhysics&,
                                 std::int64_t cycles, const Execution& how) {
                on_ranks->advance(state, cycles, *how.packed, response);
            },
            [on_ranks](State& state) { on_ranks->collect(state); });
    else if (response)
        simulation_.respond_by(*response);
}

/// Condenses the footwall of a scene that has one.
void Session::make_footwall() {
    if (!has_effect(run_.scene, "elastic_base") || footwall_)
        return;
    const PartWatch time = run_.watch(Part::base);
    std::vector<std::unique_ptr<Event>> loads;
    footwall_ = std::make_unique<FootwallCoupling>(run_.scene, run_.parts, loads);
    run_.footwall = footwall_.get();
    for (const std::string& line : footwall_->description())
        run_.log.say(line);
    for (auto& event : loads)
        simulation_.add(std::move(event));
    ElasticBase& base = footwall_->base();
    if (base.is_iterated())
        simulation_.advance_by([&base](State& state, const RigidBase& rigid,
                                       const CyclePhysics& physics, std::int64_t cycles,
                                       const Execution& how) {
            advance_iterated(base, state, rigid, physics, cycles, how);
        });
    else
        make_cycles_by(&base);
}

bool Session::resume() {
    const auto snapshots = list_snapshots(run_.options.output);
    for (auto path = snapshots.rbegin(); path != snapshots.rend(); ++path) {
        make_footwall(); // its effects are handed their memories
        try {
            Snapshot snapshot = read_snapshot(*path);
            hand_over(snapshot, simulation_.events());
            simulation_.resume(std::move(snapshot.state));
            run_.go_on_with(std::move(snapshot.record));
        } catch (const StorageError& error) {
            run_.log.say(std::string("warning: skipped: ") + error.what());
            continue;
        }
        run_.kept = *path;
        run_.past = RunHistory(run_.ended_windows());
        tell(&Output::resume);
        run_.log.say(fmt::format("resuming at {} of extension from {}",
                                 length_text(run_.extension(), run_.scene.output.interval),
                                 path->string()));
        return true;
    }
    return false;
}

void Session::begin() {
    const Scene& scene = run_.scene;
    run_.record.scene = to_toml(scene);
    CycleSpeed speed = measure_speed(estimated_discs(scene), run_.options.threads, 0.1,
                                     run_.parts.accounts_energy);
    speed.team *= run_.ranks();
    run_.record.predicted_seconds = speed.busy * predict(scene, speed).seconds;

    if (scene.picked_fault)
        run_.log.say(describe(*scene.picked_fault, *scene.detachment));
    for (const std::string& warning : scene.warnings)
        run_.log.say("warning: " + warning);
    enter(Phase::genesis);
    make_footwall();
    State state;
    {
        const PartWatch time = run_.watch(Part::genesis);
        state = make_or_recall_hanging_wall(scene, run_.parts, run_.log, run_.options.stop,
                                            run_.options.threads);
    }
    if (footwall_)
        state = settled_on_base(std::move(state));
    if (driver_.response)
        attach(driver_.nodes, state);
    simulation_.begin(std::move(state));
    run_.log.say(fmt::format("hanging wall: {} discs", run_.state().discs.rows()));
    end_window(&Output::begin);
}

/// Puts the hanging wall on the elastic base and settles it there.
State Session::settled_on_base(State state) {
    const PartWatch time = run_.watch(Part::base);
    const RigidBase& rigid = simulation_.base();
    const ElasticBase& base = footwall_->base();
    base.attach(state);
    find_contacts(state, rigid);
    base.settle(state, rigid, simulation_.physics(), run_.options.execution(),
                [&](std::string_view stage, double share) {
                    run_.options.stop.check();
                    run_.log.progress(fmt::format("{} ({:.0f} %)", stage, 100.0 * share));
                });
    return state;
}

void Session::extend() {
    simulation_.report_steps_to([this, asked = std::optional<SteadyClock::time_point>()](
                                    const std::string& done) mutable { report_step(done, asked); });
    enter(Phase::extension);
    const double tolerance = simulation_.tolerance(), target = run_.target();
    const double steps_before = run_.record.disc_steps;
    while (run_.extension() < target - tolerance) {
        if (run_.options.stop.requested()) {
            keep();
            throw Interrupted{};
        }
        const double window = next_window_end();
        const auto report = [&](const Simulation& simulation) {
            run_.record.disc_steps = steps_before + simulation.disc_steps();
            run_.log.progress(run_.progress());
            return !run_.options.stop.requested();
        };
        simulation_.extend_to(std::min(window, target), run_.options.execution(), report);
        if (run_.extension() >= window - tolerance)
            end_window(&Output::window);
    }
}

/// The first multiple of the interval that has not been reached; windows shorter than a cycle are
/// passed over. Windows are counted, not summed up, so that a resumed run has the same ends.
double Session::next_window_end() const {
    const double window = run_.scene.output.interval, tolerance = simulation_.tolerance();
    double count = std::floor((run_.extension() + tolerance) / window);
    while (run_.extension() >= count * window - tolerance)
        count += 1.0;
    return count * window;
}

void Session::end_window(Hook hook) {
    if (footwall_) {
        const PartWatch time = run_.watch(Part::measures);
        run_.window_of_base = footwall_->end_window(simulation_.state(), simulation_.base());
    }
    tell(hook);
    run_.past.add(measures::DiscPlaces(run_.state()));
}

/// Saves the present moment, unless it is.
void Session::keep() {
    if (run_.kept != run_.snapshot())
        tell(&Output::save);
}

/// Tells how far an event is that takes long. A stop request waits some seconds for its end, since
/// what was made after the last snapshot is lost without it.
void Session::report_step(const std::string& done, std::optional<SteadyClock::time_point>& asked) {
    constexpr double patience = 3.0; // s
    run_.log.progress(fmt::format("extension {:.2f} km: {}", run_.extension() / 1e3, done));
    if (!run_.options.stop.requested())
        return;
    if (!asked)
        asked = SteadyClock::now();
    if (seconds_since(*asked) < patience)
        return;
    run_.log.say(fmt::format("stopped within an event ({}); what came after {} will be made again",
                             done, run_.kept.string()));
    throw Interrupted{};
}

void Session::finish() {
    keep();
    run_.options.stop.check(); // all is kept: resumed, the run ends from here
    tell(&Output::finish);
    tell(&Output::close);
    enter(Phase::finished);
    run_.log.say(fmt::format("done: {} of extension in {}, figures in {}",
                             length_text(run_.extension()), rough_duration(run_.wall_seconds()),
                             (run_.options.output / "figures").string()));
}

} // namespace listric
