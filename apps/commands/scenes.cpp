#include "apps/commands/command.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/support/text.hpp"

#include <fmt/format.h>

#include <iostream>

namespace listric {

Command add_scenes(CLI::App& program) {
    return {program.add_subcommand("scenes", "List the scenes"), [] {
                const FlexurePlan plan = load_flexure_plan({.scene = "flexure"});
                std::cout << fmt::format("{:<12} {}\n", plan.name, plan.description);
                for (const auto& [name, description] : list_scenes())
                    std::cout << fmt::format("{:<12} {}\n", shown(name), shown(description));
                return ExitCode::done;
            }};
}

} // namespace listric
