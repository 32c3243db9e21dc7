#include "apps/studies/sweep.hpp"

#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/support/error.hpp"

#include <algorithm>
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
    CLI::App* command =
        program.add_subcommand("sweep", "Runs of a plan, a table of their measures, and effects");
    command->add_option("PLAN", request->plan, "TOML file (docs/sweeps.md)")->required();
    const CLI::Option* jobs =
        command->add_option("--jobs", request->jobs, "Runs at a time (cores over threads)")
            ->check(CLI::Range(1, 1024));
    add_threads(*command, request->threads);
    command->add_option("--output", request->output, "Folder of results (out/sweep-PLAN)");
    command->add_option("--task", *task, "Part i/n of the runs, for job arrays");
    command->add_option("--merge", request->merge, "Folders of all tasks: makes no run")
        ->expected(1, 100'000);
    command->add_flag("--quiet", request->quiet, "No progress");
    return {command,
            [request, task, jobs] {
                if (jobs->count() == 0)
                    request->jobs = std::max(1, all_threads() / request->threads);
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
