#include "apps/studies/study.hpp"

#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"

#include <fmt/format.h>

#include <memory>

namespace listric {

Command add_study(CLI::App& program) {
    const auto request = std::make_shared<StudyRequest>();
    request->threads = all_threads();
    CLI::App* command =
        add_call(program, {"Many runs",
                           "study",
                           "measure what accuracy costs",
                           "docs/explain/cost-of-accuracy.md",
                           {{{"study resolution --seeds 5", "error against the size of discs"},
                             {"study speed --scene lis2", "error against the speed of the wall"},
                             {"study isostasy -o out/isostasy", "uplift against thickness"}}}});
    std::vector<std::string> names;
    for (const Study& study : studies())
        names.push_back(fmt::format("{}: {}", study.name, study.doc));
    command->add_option("STUDY", request->name, fmt::format("one of\n{}", fmt::join(names, "\n")))
        ->type_name("STUDY")
        ->required();
    command->add_option("--scene", request->scene, "scene of studies made of runs")
        ->type_name("SCENE")
        ->default_str("the study's own, lis1 or lis1-elastic");
    add_words(*command, "--set", "KEY=VALUE", request->set,
              "change a parameter of every run; repeatable");
    add_numbers(*command, "--values", request->values, "values of the parameter that is varied")
        ->default_str("the study's own");
    add_count(*command, "--seed", request->seed, "seed of the first run");
    add_count(*command, "--seeds", request->seeds, "runs for each value");
    add_threads(*command, request->threads);
    add_output(*command, request->output, "out/study-STUDY");
    add_quiet(*command, request->quiet);
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_study(*request);
                return ExitCode::done;
            },
            "the same call goes on from here"};
}

} // namespace listric
