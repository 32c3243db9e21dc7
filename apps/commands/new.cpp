#include "apps/commands/command.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/toml/template.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

namespace listric {

namespace {

struct NewCall {
    std::filesystem::path file;
    std::string from = "lis1";
};

ExitCode write_scene(const NewCall& call) {
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(call.file, error)))
        throw UsageError(fmt::format("{}: exists, and new replaces no file; give another name",
                                     shown(call.file.string())));
    if (call.file.extension() != ".toml")
        throw UsageError(fmt::format("{}: a scene's name ends with .toml; give {}.toml",
                                     shown(call.file.string()), shown(call.file.string())));
    write_text(call.file, scene_template(call.from, program_effects()));
    std::cout << call.file.string() << '\n';
    return ExitCode::done;
}

} // namespace

Command add_new(CLI::App& program) {
    const auto call = std::make_shared<NewCall>();
    CLI::App* command =
        add_call(program, {"Run",
                           "new",
                           "write a commented scene to begin with",
                           "docs/start/your-own-section.md",
                           {{{"new my.toml", "a scene with the parameters of lis1"},
                             {"new ramps.toml --from rfr", "a detachment with two ramps"},
                             {"new soft.toml --from my.toml", "a variant of your own scene"}}}});
    command->add_option("FILE", call->file, "the scene to write; it must not exist")
        ->type_name("FILE")
        ->required();
    command->add_option("--from", call->from, "scene with which to begin, by name or file")
        ->type_name("SCENE")
        ->default_str(call->from);
    return {command, [call] { return write_scene(*call); }};
}

} // namespace listric
