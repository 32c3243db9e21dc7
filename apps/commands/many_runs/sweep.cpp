#include "apps/studies/sweep/sweep.hpp"

#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/support/error.hpp"

#include <charconv>
#include <memory>
#include <utility>

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

/// How many points --emulate shall suggest.
int parse_points(const std::string& text) {
    constexpr int most = 100;
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0 || number > most)
        throw UsageError("--emulate=" + text + ": a number of points to suggest, from 0 to 100");
    return number;
}

/// Refuses options that belong to another use of the call.
/// @param list  whether --list and --json are given
void require_one_of(const SweepRequest& request, std::pair<bool, bool> list) {
    const bool merges = !request.merge.empty();
    if (request.task && merges)
        throw UsageError("--task makes runs, --merge reads those of all tasks: one or the other");
    if (list.first && (request.task || merges))
        throw UsageError("--list prints all runs of the plan: leave out --task and --merge");
    if (list.second && !list.first)
        throw UsageError("--json is for --list");
    if (request.so_far && !merges)
        throw UsageError("--so-far is for --merge");
}

} // namespace

Command add_sweep(CLI::App& program) {
    const auto request = std::make_shared<SweepRequest>();
    const auto task = std::make_shared<std::string>();
    const auto list = std::make_shared<std::pair<bool, bool>>(false, false); // asked for, as JSON
    const auto suggest = std::make_shared<std::string>();                    // empty: no emulator
    CLI::App* command =
        add_call(program, {"Many runs",
                           "sweep",
                           "make the runs of a plan and compare them",
                           "docs/guides/sweeps.md",
                           {{{"sweep plan.toml --jobs 2", "two runs at a time"},
                             {"sweep plan.toml --list", "a call for each run, for other engines"},
                             {"sweep plan.toml --merge out/sweep-plan --so-far",
                              "a table of the runs that are there"}}}});
    command->add_option("PLAN", request->plan, "plan of the sweep, a TOML file")
        ->type_name("FILE")
        ->required();
    add_many_runs(*command, *request, "out/sweep-PLAN");
    command->add_option("--task", *task, "part i/n of the runs, for job arrays")
        ->type_name("PART")
        ->default_str("all runs");
    command->add_flag("--lean", request->is_lean, "keep of a run what --lean of run keeps");
    command->add_flag("--list", list->first,
                      "print a call for each run, with its time, memory and disk; make no run");
    command->add_flag("--json", list->second, "list as JSON");
    command
        ->add_option("--merge", request->merge,
                     "read the folders of all tasks, or of runs that other engines have made; "
                     "make no run")
        ->type_name("DIR")
        ->default_str("none")
        ->expected(1, 100'000);
    command->add_flag("--so-far", request->so_far,
                      "merge though runs are missing: their outcome is \"not yet\"");
    command
        ->add_flag(
            "--emulate{0}", *suggest,
            "what the table says of runs that nobody has made: errors and Sobol's indices by "
            "measure; N: print so many points that would tell most; make no run")
        ->type_name("N")
        ->default_str("none")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    add_quiet(*command, request->quiet);
    return {command,
            [request, task, list, suggest] {
                if (!task->empty())
                    request->task = parse_task(*task);
                require_one_of(*request, *list);
                request->stop = stop_on_signals();
                if (!suggest->empty()) {
                    emulate_sweep(*request, parse_points(*suggest));
                    return ExitCode::done;
                }
                if (list->first) {
                    list_sweep(*request, list->second);
                    return ExitCode::done;
                }
                return run_sweep(*request) ? ExitCode::done : ExitCode::numerics_failed;
            },
            "the same call goes on from here"};
}

} // namespace listric
