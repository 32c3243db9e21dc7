#include "apps/run/session.hpp"

#include "apps/archive/folder/run_folder.hpp"
#include "apps/run/build.hpp"
#include "apps/run/forecast/hints.hpp"
#include "apps/run/forecast/prediction.hpp"

#include <fmt/format.h>

#include <utility>

namespace listric {

using namespace archive;
using namespace dem;

Session::Session(const Scene& scene, const RunOptions& options, Log& log, OutputList outputs)
    : run_(scene, options, log, simulation_), simulation_(run_.parts.base, run_.parts.physics) {
    add_events(simulation_, run_);
    for (const MakeOutput make : outputs)
        if (auto output = make(run_))
            outputs_.push_back(std::move(*output));
}

RunOutcome Session::run() {
    run_.expect(forecast_now(run_.scene, run_.target().m, run_.options, run_.ranks()));
    if (!run_.options.warned)
        for (const std::string& warning : run_.scene.warnings)
            run_.log.say("warning: " + warning);
    try {
        if (!run_.options.resume || !resume())
            begin();
        extend();
        finish();
        return RunOutcome::finished;
    } catch (const Interrupted&) {
        enter(Phase::stopped);
        run_.log.say(fmt::format("stopped at {}; {}", run_.place_text(run_.scene.output.interval),
                                 resume_hint(run_.options.output)));
        return RunOutcome::interrupted;
    } catch (...) {
        if (run_.ranks() == 1) // other processes answer no more
            try {
                enter(Phase::failed);
            } catch (const std::exception&) {
                // what ended the run says more
            }
        throw;
    }
}

void Session::tell(Hook hook) {
    for (const Output& output : outputs_)
        if (output.*hook) {
            const PartWatch time = run_.watch(output.part);
            (output.*hook)(run_);
        }
}

void Session::enter(Phase phase) {
    run_.phase = phase;
    tell(&Output::enter);
}

bool Session::resume() {
    const auto snapshots = list_snapshots(run_.options.output);
    for (auto path = snapshots.rbegin(); path != snapshots.rend(); ++path) {
        drive(simulation_, run_); // its effects are handed their memories
        try {
            Snapshot snapshot = read_snapshot(*path);
            hand_over(snapshot, simulation_.events(), *path);
            if (run_.driver)
                run_.driver->require_own(snapshot.state);
            simulation_.resume(std::move(snapshot.state));
            run_.go_on_with(*path, std::move(snapshot.record));
        } catch (const UnreadableFile&) { // it may be good: to begin anew would replace it
            throw;
        } catch (const StorageError& error) {
            run_.log.say(std::string("warning: skipped: ") + error.what());
            continue;
        }
        tell(&Output::resume);
        run_.log.say(fmt::format("resuming at {} from {}",
                                 run_.place_text(run_.scene.output.interval), path->string()));
        return true;
    }
    return false;
}

void Session::begin() {
    run_.begin_record();
    if (run_.scene.picked_fault)
        run_.log.say(describe(*run_.scene.picked_fault, *run_.scene.detachment));
    enter(Phase::genesis);
    start(simulation_, run_, kept_hanging_wall);
    end_window(&Output::begin);
}

void Session::extend() {
    simulation_.report_steps_to([this](const std::string& done) { report_step(done); });
    enter(Phase::extension);
    const double steps_before = run_.record.disc_steps;
    run_.count_cycles();
    const auto report = [&](const Simulation& simulation) {
        run_.record.disc_steps = steps_before + simulation.disc_steps();
        run_.count_cycles();
        run_.show_progress();
        return !run_.options.stop.requested();
    };
    const auto end_of_window = [&] {
        end_window(&Output::window);
        return !run_.options.stop.requested();
    };
    if (run_.options.stop.requested() ||
        !extend_by_windows(simulation_, run_, run_.target(), report, end_of_window)) {
        keep();
        throw Interrupted{};
    }
}

void Session::end_window(Hook hook) {
    listric::end_window(simulation_, run_, [&] { tell(hook); });
}

/// Saves the present moment, unless it is.
void Session::keep() {
    if (run_.kept != run_.snapshot())
        tell(&Output::save);
}

/// Tells how far an event is that takes long. A stop request waits some seconds for its end, since
/// everything after the last snapshot is lost without it.
void Session::report_step(const std::string& done) {
    constexpr double patience = 3.0; // s
    run_.show_progress(done);
    if (!run_.options.stop.requested())
        return;
    if (!stop_seen_)
        stop_seen_ = SteadyClock::now();
    if (seconds_since(*stop_seen_) < patience)
        return;
    run_.log.say(fmt::format("stopped within an event ({}); what came after {} will be made again",
                             done, run_.kept.string()));
    throw Interrupted{};
}

void Session::finish() {
    run_.end_cycles();
    run_.show_progress("figures and report");
    keep();
    run_.options.stop.check(); // all is kept: resumed, the run ends from here
    tell(&Output::finish);
    tell(&Output::close);
    enter(Phase::finished);
}

} // namespace listric
