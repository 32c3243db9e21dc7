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
    CLI::App* command = add_call(
        program, {"Many runs",
                  "validate",
                  "run the published experiments and judge them",
                  "docs/validation.md",
                  {{{"validate --accuracy draft --seeds 2", "two seeds at half the resolution"},
                    {"validate --only lis2 --jobs 2", "one experiment, two runs at a time"},
                    {"validate --plan my-plan.toml", "your own runs and expectations"}}}});
    command
        ->add_option("--accuracy", request->accuracy,
                     fmt::format("resolution of the runs: {}", fmt::join(accuracy_names(), ", ")))
        ->type_name("LEVEL")
        ->default_str(request->accuracy);
    add_count(*command, "--seeds", request->seeds, "runs per experiment", 1, 1000);
    add_count(*command, "--first-seed", request->first_seed, "seed of the first run", 0,
              1'000'000'000);
    add_count(*command, "-j,--jobs", request->jobs, "runs at a time", 1, 1024);
    command->add_option("--runs", request->runs, "folder of the runs")
        ->type_name("DIR")
        ->default_str("out/validation-LEVEL");
    command->add_option("-o,--output", request->output, "file of the document")
        ->type_name("FILE")
        ->default_str("validation.md beside the runs");
    command->add_option("--only", request->only, "one experiment")
        ->type_name("EXPERIMENT")
        ->default_str("all");
    command->add_option("--plan", request->plan, "runs and expectations, a TOML file")
        ->type_name("FILE")
        ->default_str("apps/studies/validation.toml");
    add_threads(*command, request->threads);
    command->add_flag("--remeasure", request->remeasure, "measure all runs again");
    command->add_flag("--without-runs", request->without_runs, "use only the runs that exist");
    add_quiet(*command, request->quiet);
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_validation(*request);
                return ExitCode::done;
            },
            "the same call goes on from here"};
}

} // namespace listric
