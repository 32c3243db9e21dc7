#include "apps/scene/toml/schema.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/commands/command.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"
#include "apps/studies/validation/validation_plan.hpp"

#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace listric {

Command add_schema(CLI::App& program) {
    const auto material = std::make_shared<bool>(false);
    const auto flexure = std::make_shared<bool>(false);
    const auto sweep = std::make_shared<bool>(false);
    const auto validation = std::make_shared<bool>(false);
    const auto measures = std::make_shared<bool>(false);
    CLI::App* command =
        add_call(program, {"Shell",
                           "schema",
                           "print the JSON schema of scenes, for editors",
                           "docs/guides/editors.md",
                           {{{"schema > scene.schema.json", "for an editor of scenes"},
                             {"schema --material", "the schema of material files"},
                             {"schema --measures", "names, units and definitions of measures"}}}});
    command->add_flag("--material", *material, "print the schema of material files instead");
    command->add_flag("--flexure", *flexure, "print the schema of plans of flexure instead");
    command->add_flag("--sweep", *sweep, "print the schema of sweep plans instead");
    command->add_flag("--validation", *validation, "print the schema of validation plans instead");
    command->add_flag("--measures", *measures,
                      "print names, units and definitions of measures instead");
    return {command, [material, flexure, sweep, validation, measures] {
                if (*measures) {
                    std::cout << to_text(archive::dictionary_json(program_effects()), 1) << '\n';
                    return ExitCode::done;
                }
                std::cout << (*material     ? material_schema()
                              : *flexure    ? flexure_schema()
                              : *sweep      ? sweep_schema()
                              : *validation ? validation_schema()
                                            : scene_schema(program_effects()));
                return ExitCode::done;
            }};
}

} // namespace listric
