#include "apps/studies/sweep/sweep.hpp"

#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/support/error.hpp"

#include <memory>

namespace listric {

namespace {

/// "2/4"
SweepTask parse_task(const std::string& text) {
    SweepTask task;
    int used = 0;
    if (std::sscanf(text.c_str(), "%d/%d%n", &task.number, &task.of, &used) != 2 ||
        static_cast<std::size_t>(used) != text.size() || task.number < 1 || task.number > task.of)
        throw UsageError("--task " + text + ": needs the form i/n, from 1/n to n/n");
    return task;
}

} // namespace

Command add_sweep(CLI::App& program) {
    const auto request = std::make_shared<SweepRequest>();
    const auto task = std::make_shared<std::string>();
    CLI::App* command = add_call(
        program, {"Many runs",
                  "sweep",
                  "make the runs of a plan and compare them",
                  "docs/guides/sweeps.md",
                  {{{"sweep plan.toml --jobs 2", "two runs at a time"},
                    {"sweep plan.toml --task 1/4", "the first of four parts, on a cluster"},
                    {"sweep plan.toml --merge a b c d", "the tables of the four parts"}}}});
    command->add_option("PLAN", request->plan, "plan of the sweep, a TOML file")
        ->type_name("FILE")
        ->required();
    add_many_runs(*command, *request, "out/sweep-PLAN");
    command->add_option("--task", *task, "part i/n of the runs, for job arrays")
        ->type_name("PART")
        ->default_str("all runs");
    command->add_option("--merge", request->merge, "read the folders of all tasks; make no run")
        ->type_name("DIR")
        ->default_str("none")
        ->expected(1, 100'000);
    add_quiet(*command, request->quiet);
    return {command,
            [request, task] {
                if (!task->empty())
                    request->task = parse_task(*task);
                if (request->task && !request->merge.empty())
                    throw UsageError("--task makes runs, --merge reads those of all tasks: one or "
                                     "the other");
                request->stop = stop_on_signals();
                return run_sweep(*request) ? ExitCode::done : ExitCode::numerics_failed;
            },
            "the same call goes on from here"};
}

} // namespace listric
