#include "apps/scene/schema.hpp"

#include "apps/archive/dictionary.hpp"
#include "apps/commands/command.hpp"
#include "apps/model/effects.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/support/json_text.hpp"

#include <iostream>
#include <memory>

namespace listric {

Command add_schema(CLI::App& program) {
    const auto material = std::make_shared<bool>(false);
    const auto flexure = std::make_shared<bool>(false);
    const auto measures = std::make_shared<bool>(false);
    CLI::App* command = program.add_subcommand("schema", "JSON schema of scene files, for editors");
    command->add_flag("--material", *material, "Of material files instead");
    command->add_flag("--flexure", *flexure, "Of plans of flexure instead");
    command->add_flag("--measures", *measures, "What is measured: names, units, definitions");
    return {command, [material, flexure, measures] {
                if (*measures) {
                    std::cout << to_text(archive::dictionary_json(program_effects()), 1) << '\n';
                    return ExitCode::done;
                }
                std::cout << (*material  ? material_schema()
                              : *flexure ? flexure_schema()
                                         : scene_schema(program_effects()));
                return ExitCode::done;
            }};
}

} // namespace listric
