#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/studies/validation/validation.hpp"
#include "apps/support/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace listric {

namespace {

/// Takes over the seeds that a call asks for. Throws UsageError.
void ask_for_seeds(ValidationRequest& request, const std::string& text, int first, bool has_first) {
    constexpr int usual = 5;
    if (text.empty() && !has_first)
        return;
    const bool is_count = text.find_first_not_of("0123456789") == text.npos;
    const auto listed = text.empty() ? std::vector{usual} : seed_list(text);
    if (!listed || (is_count && (listed->front() < 1 || listed->front() > 1000)))
        throw UsageError(fmt::format(
            "--seeds {}: allowed: a number of runs, 1 to 1000, or seeds such as 51-56,60", text));
    if (!is_count && has_first)
        throw UsageError(fmt::format("--seeds {} says which; --first-seed belongs to a number of "
                                     "runs",
                                     text));
    if (is_count && !has_first) {
        request.number = listed->front();
        return;
    }
    request.seeds = *listed;
    if (!is_count)
        return;
    request.seeds.resize(static_cast<std::size_t>(listed->front()));
    std::iota(request.seeds.begin(), request.seeds.end(), first);
}

} // namespace

Command add_validate(CLI::App& program) {
    const auto request = std::make_shared<ValidationRequest>();
    const auto seeds = std::make_shared<std::string>();
    const auto first_seed = std::make_shared<int>(1);
    request->threads = all_threads();
    CLI::App* command = add_call(
        program, {"Many runs",
                  "validate",
                  "run the published experiments and judge them",
                  "docs/explain/validation.md",
                  {{{"validate --accuracy draft --seeds 2", "two seeds at half the resolution"},
                    {"validate --only lis2 --seeds 51-56", "add these seeds to the record"},
                    {"validate --plan benchmarks", "numbers of other works, or your own plan"}}}});
    command
        ->add_option("--accuracy", request->accuracy,
                     fmt::format("resolution of the runs: {}", fmt::join(accuracy_names(), ", ")))
        ->type_name("LEVEL")
        ->default_str(request->accuracy);
    command->add_option("--seeds", *seeds, "so many of the plan's seeds, or seeds such as 51-56,60")
        ->type_name("N or SEEDS")
        ->default_str("the plan's, or 5");
    add_count(*command, "--first-seed", *first_seed, "seed of the first of N runs", 0,
              1'000'000'000);
    add_count(*command, "-j,--jobs", request->jobs, "runs at a time", 1, 1024);
    command->add_option("--runs", request->runs, "folder of the runs")
        ->type_name("DIR")
        ->default_str("out/PLAN-LEVEL");
    command->add_option("-o,--output", request->output, "file of the document")
        ->type_name("FILE")
        ->default_str("PLAN.md beside the runs");
    add_words(*command, "--only", "EXPERIMENT", request->only,
              "run and measure this experiment; repeatable");
    command->get_option("--only")->default_str("all");
    command
        ->add_option("--plan", request->plan,
                     "runs and expectations: a name in apps/studies, or a TOML file")
        ->type_name("PLAN")
        ->default_str(request->plan);
    add_threads(*command, request->threads);
    command->add_flag("--remeasure", request->remeasure, "measure all runs again");
    command->add_flag("--without-runs", request->without_runs, "use only the runs that exist");
    command->add_flag("--mixed", request->mixed,
                      "take a record of other measures or parameters, and name the mixture");
    add_quiet(*command, request->quiet);
    return {command,
            [request, seeds, first_seed, command] {
                ask_for_seeds(*request, *seeds, *first_seed, command->count("--first-seed") > 0);
                request->stop = stop_on_signals();
                run_validation(*request);
                return ExitCode::done;
            },
            "the same call goes on from here"};
}

} // namespace listric
