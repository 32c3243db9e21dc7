#include "apps/studies/dataset/dataset.hpp"

#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"

#include <memory>

namespace listric {

Command add_dataset(CLI::App& program) {
    const auto request = std::make_shared<DatasetRequest>();
    CLI::App* command = add_call(
        program,
        {"Many runs",
         "dataset",
         "make seismic sections with labelled faults of the runs of a plan",
         "docs/guides/dataset.md",
         {{{"dataset seismics --jobs 2", "the shipped plan, 1,000 sections"},
           {"dataset plan.toml --so-far", "of the runs that are there; make none"},
           {"dataset plan.toml --runs out/cluster", "of runs that another engine made"}}}});
    command->add_option("PLAN", request->plan, "plan of a sweep with [dataset]: its name or file")
        ->type_name("FILE")
        ->required();
    add_many_runs(*command, *request, "out/dataset-PLAN");
    command->add_option("--runs", request->runs, "folder of the sweep that has the runs")
        ->type_name("DIR")
        ->default_str("out/sweep-PLAN");
    command->add_flag("--so-far", request->so_far,
                      "make no run: sections of those that are finished");
    add_quiet(*command, request->quiet);
    return {command,
            [request] {
                request->stop = stop_on_signals();
                return make_dataset(*request) ? ExitCode::done : ExitCode::numerics_failed;
            },
            "the same call goes on from here"};
}

} // namespace listric
