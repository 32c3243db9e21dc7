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
        program.add_subcommand("study", "Accuracy against time: a table and a figure");
    std::string names;
    for (const Study& study : studies())
        names += fmt::format("\n{:<12} {}", study.name, study.doc);
    command->add_option("NAME", request->name, "One of:" + names)->required();
    command->add_option("--scene", request->scene, "Scene of studies made of runs (lis1)");
    add_words(*command, "--set", request->set, "table.key=value, for every run; repeatable");
    add_numbers(*command, "--values", request->values, "Values of the parameter that is varied");
    command->add_option("--seed", request->seed, "Seed of the first run");
    command->add_option("--seeds", request->seeds, "Runs for each value");
    add_threads(*command, request->threads);
    command->add_option("--output", request->output, "Folder of results (out/study-NAME)");
    command->add_flag("--quiet", request->quiet, "No progress");
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_study(*request);
                return ExitCode::done;
            },
            "the same call goes on from here"};
}

} // namespace listric
