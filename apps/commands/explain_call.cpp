#include "apps/commands/asked_accuracy.hpp"
#include "apps/commands/command.hpp"
#include "apps/commands/explain.hpp"
#include "apps/model/effects.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/text.hpp"

#include <iostream>
#include <memory>

namespace listric {

namespace {

struct ExplainCall {
    SceneRequest scene;
    AskedAccuracy asked;
    int threads = all_threads();
    bool parameters = false; ///< their reference, instead of a scene
};

ExitCode explain(const ExplainCall& call) {
    if (call.parameters)
        std::cout << parameter_reference(program_effects()) << flexure_reference();
    else if (call.scene.scene.empty())
        throw UsageError("explain: a scene is needed, or --parameters");
    else if (is_flexure_plan(call.scene.scene))
        std::cout << shown_lines(explain(load_flexure_plan(call.scene)));
    else if (call.asked.is_asked())
        std::cout << shown_lines(explain_asked(call.asked, call.scene, call.threads));
    else {
        const Scene scene = load_scene(call.scene);
        std::cout << shown_lines(explain(scene, call.threads, program_effects()));
        for (const std::string& warning : scene.warnings)
            warn(warning);
    }
    return ExitCode::done;
}

} // namespace

Command add_explain(CLI::App& program) {
    const auto call = std::make_shared<ExplainCall>();
    CLI::App* command =
        add_call(program, {"Run",
                           "explain",
                           "print what a scene simulates and costs",
                           "docs/guides/choosing.md",
                           {{{"explain lis1", "sizes, memory and expected time"},
                             {"explain lis1 --within 10min", "the best that this time buys"},
                             {"explain --parameters", "every parameter of a scene"}}}});
    add_scene(*command, call->scene);
    command->get_option("SCENE")
        ->required(false)
        ->description("name of a scene (listric scenes), or a file; --parameters needs none")
        ->default_str("none");
    add_asked_accuracy(*command, call->asked);
    add_threads(*command, call->threads);
    command->add_flag("--parameters", call->parameters,
                      "print the reference of all parameters instead");
    return {command, [call] { return explain(*call); }};
}

} // namespace listric
