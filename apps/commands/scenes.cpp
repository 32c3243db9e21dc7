#include "apps/commands/command.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <iostream>

namespace listric {

Command add_scenes(CLI::App& program) {
    CLI::App* command = add_call(program, {"Run",
                                           "scenes",
                                           "list the shipped scenes",
                                           "docs/start/gallery.md",
                                           {{{"scenes", "all scenes, a line each"},
                                             {"explain lis2", "processes and cost of one of them"},
                                             {"run lis2 --accuracy draft", "run one of them"}}}});
    return {command, [] {
                const FlexurePlan plan = load_flexure_plan({.scene = "flexure"});
                std::cout << fmt::format("{:<12} {}\n", plan.name, plan.description);
                for (const auto& [name, description] : list_scenes())
                    std::cout << fmt::format("{:<12} {}\n", shown(name), shown(description));
                return ExitCode::done;
            }};
}

} // namespace listric
