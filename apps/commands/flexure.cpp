#include "apps/studies/flexure.hpp"

#include "apps/commands/command.hpp"

#include <memory>

namespace listric {

Command add_flexure(CLI::App& program) {
    struct Call {
        SceneRequest plan{.scene = "flexure"};
        RunOptions options;
    };
    const auto call = std::make_shared<Call>();
    CLI::App* command = program.add_subcommand(
        "flexure", "Bend the elastic base alone under a load, against theory");
    command->add_option("PLAN", call->plan.scene, "TOML file (the plan that the program ships)");
    add_words(*command, "--set", call->plan.set, "table.key=value; repeatable");
    command->add_option("--output", call->options.output, "Folder of results (out/PLAN)");
    command->add_flag("--resume", call->options.resume, "Leave a finished one as it is");
    command->add_flag("--force", call->options.force, "Replace what is in the folder");
    command->add_flag("--quiet", call->options.quiet, "No messages");
    return {command, [call] {
                const FlexurePlan plan = load_flexure_plan(call->plan);
                if (call->options.output.empty())
                    call->options.output = "out/" + plan.name;
                run_flexure(plan, call->options);
                return ExitCode::done;
            }};
}

} // namespace listric
