#include "apps/commands/command.hpp"

#include <iostream>
#include <memory>

namespace listric {

Command add_help(CLI::App& program) {
    const auto name = std::make_shared<std::string>();
    CLI::App* command = add_call(program, {"Shell",
                                           "help",
                                           "print arguments, options and examples of a call",
                                           "docs/reference/commands.md",
                                           {{{"help", "all calls"},
                                             {"help run", "one call"},
                                             {"run --help", "one call, by its option"}}}});
    command->add_option("CALL", *name, "one of the calls")
        ->type_name("CALL")
        ->default_str("the overview");
    return {command, [&program, name] {
                if (!name->empty())
                    require_call(program, *name);
                std::cout << help_of(name->empty() ? program : *program.get_subcommand(*name),
                                     help_width());
                return ExitCode::done;
            }};
}

} // namespace listric
