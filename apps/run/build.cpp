#include "apps/run/build.hpp"

#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "coupling/strong_scheme.hpp"
#include "dem/contacts.hpp"
#include "dem/ranked_cycles.hpp"

#include <fmt/format.h>

#include <utility>

namespace listric {

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

void add_events(Simulation& simulation, RunView& run) {
    for (auto& event : make_events(run.scene, run.parts))
        simulation.add(std::move(event));
    simulation.report_times_to([&run](const std::string& part, double seconds) {
        const double base = run.footwall ? std::exchange(run.footwall->base().seconds, 0.0) : 0.0;
        run.record.seconds_by_part[part] += seconds - base;
        if (base > 0.0)
            run.record.seconds_by_part[name(Part::base)] += base;
    });
}

void drive(Simulation& simulation, RunView& run) {
    if (has_effect(run.scene, "elastic_base") && !run.footwall) {
        const PartWatch time = run.watch(Part::base);
        std::vector<std::unique_ptr<Event>> loads;
        run.footwall = std::make_unique<FootwallCoupling>(run.scene, run.parts, loads);
        for (const std::string& line : run.footwall->description())
            run.log.say(line);
        for (auto& event : loads)
            simulation.add(std::move(event));
    }
    ElasticBase* const elastic = run.footwall ? &run.footwall->base() : nullptr;
    BaseResponse* const response = elastic ? elastic : run.driver.response.get();
    if (elastic && elastic->is_iterated())
        return simulation.advance_by([elastic](State& state, const RigidBase& rigid,
                                               const CyclePhysics& physics, std::int64_t cycles,
                                               const Execution& how) {
            advance_iterated(*elastic, state, rigid, physics, cycles, how);
        });
    if (RankedCycles* const on_ranks = run.options.on_ranks)
        simulation.advance_by(
            [on_ranks, response](State& state, const RigidBase&, const CyclePhysics&,
                                 std::int64_t cycles, const Execution& how) {
                on_ranks->advance(state, cycles, *how.packed, response);
            },
            [on_ranks](State& state) { on_ranks->collect(state); });
    else if (response)
        simulation.respond_by(*response);
}

void start(Simulation& simulation, RunView& run) {
    drive(simulation, run);
    State state;
    {
        const PartWatch time = run.watch(Part::genesis);
        state = make_or_recall_hanging_wall(run.scene, run.parts, run.log, run.options.stop,
                                            run.options.threads);
    }
    if (run.footwall) {
        const PartWatch time = run.watch(Part::base);
        const RigidBase& rigid = simulation.base();
        const ElasticBase& base = run.footwall->base();
        base.attach(state);
        find_contacts(state, rigid);
        base.settle(state, rigid, simulation.physics(), run.options.execution(),
                    [&](std::string_view stage, double share) {
                        run.options.stop.check();
                        run.log.progress(fmt::format("{} ({:.0f} %)", stage, 100.0 * share));
                    });
    }
    if (run.driver.response)
        attach(run.driver.nodes, state);
    simulation.begin(std::move(state));
    run.log.say(fmt::format("hanging wall: {} discs", run.state().discs.rows()));
}

} // namespace listric
