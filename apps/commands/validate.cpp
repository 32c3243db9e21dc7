#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/studies/validation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace listric {

Command add_validate(CLI::App& program) {
    const auto request = std::make_shared<ValidationRequest>();
    request->threads = all_threads();
    CLI::App* command = program.add_subcommand(
        "validate", "Run the paper's experiments and write what is met and what is missed");
    command->add_option("--accuracy", request->accuracy,
                        fmt::format("Accuracy of the runs: {}", fmt::join(accuracy_names(), ", ")));
    command->add_option("--seeds", request->seeds, "Runs per experiment")
        ->check(CLI::Range(1, 1000));
    command->add_option("--first-seed", request->first_seed, "Seed of the first run")
        ->check(CLI::Range(0, 1'000'000'000));
    command->add_option("--jobs", request->jobs, "Runs at a time")->check(CLI::Range(1, 1024));
    command->add_option("--runs", request->runs, "Folder of the runs (out/validation-ACCURACY)");
    command->add_option("--output", request->output, "Document (validation.md beside the runs)");
    command->add_option("--only", request->only, "One experiment");
    command->add_option("--plan", request->plan,
                        "Runs and expectations (apps/studies/validation.toml)");
    add_threads(*command, request->threads);
    command->add_flag("--remeasure", request->remeasure, "Measure all runs anew");
    command->add_flag("--without-runs", request->without_runs, "Take the runs that are there");
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_validation(*request);
                return ExitCode::done;
            },
            "the same call goes on from here"};
}

} // namespace listric
