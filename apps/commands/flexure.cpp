#include "apps/studies/flexure_plan.hpp"

#include "apps/commands/command.hpp"

#include <memory>

namespace listric {

Command add_flexure(CLI::App& program) {
    struct Call {
        SceneRequest plan{.scene = "flexure"};
        RunOptions options;
    };
    const auto call = std::make_shared<Call>();
    CLI::App* command = add_call(
        program, {"Run",
                  "flexure",
                  "bend the elastic base alone under a load, and compare with theory",
                  "docs/explain/elastic-base.md",
                  {{{"flexure", "a line load on the plate of the shipped plan"},
                    {"flexure --set flexure.load=broken", "a load on the end of a broken plate"},
                    {"flexure my-plan.toml -o out/mine", "a plan of your own"}}}});
    command->add_option("PLAN", call->plan.scene, "plan, a TOML file")
        ->type_name("FILE")
        ->default_str("the shipped plan");
    add_words(*command, "--set", "KEY=VALUE", call->plan.set, "change a parameter; repeatable");
    add_output(*command, call->options.output, "out/PLAN");
    command->add_flag("--resume", call->options.resume, "leave a finished run as it is");
    command->add_flag("--force", call->options.force, "replace the run in the folder");
    add_quiet(*command, call->options.quiet);
    return {command, [call] {
                const FlexurePlan plan = load_flexure_plan(call->plan);
                if (call->options.output.empty())
                    call->options.output = "out/" + plan.name;
                run_flexure(plan, call->options);
                return ExitCode::done;
            }};
}

} // namespace listric
