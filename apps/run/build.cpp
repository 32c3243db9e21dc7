#include "apps/run/build.hpp"

#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "dem/ranks/ranked_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace listric {

using namespace dem;

void add_events(Simulation& simulation, RunView& run) {
    for (auto& event : make_events(run.scene, run.parts))
        simulation.add(std::move(event));
    simulation.report_times_to([&run](const std::string& part, double seconds) {
        const double base = run.driver ? run.driver->take_seconds() : 0.0;
        run.record.seconds_by_part[part] += seconds - base;
        if (base > 0.0)
            run.record.seconds_by_part[name(Part::base)] += base;
    });
}

void drive(Simulation& simulation, RunView& run) {
    if (run.parts.base_moves && !run.driver) {
        const PartWatch time = run.watch(Part::base);
        std::vector<std::unique_ptr<Event>> loads;
        run.driver = make_base_driver(run.scene, run.parts, simulation.events(), loads);
        for (const std::string& line : run.driver->description())
            run.log.say(line);
        for (auto& event : loads)
            simulation.add(std::move(event));
    }
    BaseResponse* const response = run.driver ? &run.driver->response() : nullptr;
    if (RankedCycles* const on_ranks = run.options.on_ranks)
        simulation.advance_by(
            [on_ranks, response](State& state, const RigidBase&, const CyclePhysics&,
                                 std::int64_t cycles, const Execution& how) {
                on_ranks->advance(state, cycles, how.state_is_untouched, response);
            },
            [on_ranks](State& state) { on_ranks->collect(state); });
    else if (response)
        simulation.respond_by(*response);
}

State kept_hanging_wall(const RunView& run, const StageReport& report) {
    return make_or_recall_hanging_wall(run.scene, run.parts, run.log, report, run.options.stop,
                                       run.options.threads);
}

State own_hanging_wall(const RunView& run, const StageReport& report) {
    return make_hanging_wall(run.scene, run.parts, report, run.options.stop, run.options.threads);
}

void start(Simulation& simulation, RunView& run, HangingWallSource* hanging_wall) {
    drive(simulation, run);
    const auto report = [&](std::string_view stage, double share) {
        run.show_progress(fmt::format("{} ({:.0f} %)", stage, 100.0 * share));
    };
    State state;
    {
        const PartWatch time = run.watch(Part::genesis);
        state = hanging_wall(run, report);
    }
    if (run.driver) {
        const PartWatch time = run.watch(Part::base);
        run.driver->settle(state, simulation.base(), simulation.physics(), run.options.execution(),
                           [&](std::string_view stage, double share) {
                               run.options.stop.check();
                               report(stage, share);
                           });
    }
    simulation.begin(std::move(state));
    run.log.say(fmt::format("hanging wall: {} discs", run.state().discs.rows()));
}

void end_window(Simulation& simulation, RunView& run, const std::function<void()>& tell) {
    if (run.driver) {
        const PartWatch time = run.watch(Part::measures);
        run.window_of_base = run.driver->end_window(simulation.state(), simulation.base());
    }
    tell();
    run.past.add(measures::DiscPlaces(run.state()));
}

bool extend_by_windows(Simulation& simulation, const RunView& run, Travel goal,
                       const Simulation::Report& report,
                       const std::function<bool()>& end_of_window) {
    const Travel tolerance = simulation.tolerance();
    bool goes_on = true;
    while (goes_on && !has_come_to(run.travel(), goal, tolerance)) {
        const Travel window = run.next_window_end();
        goes_on = simulation.extend_to(std::min(window, goal).m, run.options.execution(), report);
        if (has_come_to(run.travel(), window, tolerance))
            goes_on = end_of_window() && goes_on;
    }
    return goes_on;
}

} // namespace listric
