#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

// Help of the program and of its calls, for terminals, the manual's page, shells and documents: all
// from the declarations of calls and options.

namespace listric {

/// A call that can be pasted, without the program's name, and what it is for.
struct Example {
    const char* call;
    const char* purpose;
};

/// Help on a call beside its options.
struct CallHelp {
    const char* group; ///< in the overview
    const char* name;
    const char* purpose; ///< begins with a verb
    const char* page;    ///< of the documents
    std::array<Example, 3> examples;
};

/// Adds a call to the program's. Its examples and page are its footer.
CLI::App* add_call(CLI::App& program, const CallHelp& help);

/// The calls among a call's examples, with the program's name in front.
std::vector<std::string> example_calls(const CLI::App& call);

/// The kind of value that an option takes, in words: "N", "DIR". Empty for a flag.
std::string kind_of(const CLI::Option& option);

/// The words that an option's own check allows; empty: any.
std::vector<std::string> choices_of(const CLI::Option& option);

/// "-o", "--output"; none of an argument.
std::vector<std::string> names_of(const CLI::Option& option);

/// "-o, --output DIR", or an argument's name.
std::string head_of(const CLI::Option& option);

/// An option's purpose, with its default.
std::string text_of(const CLI::Option& option);

/// "run SCENE"
std::string usage_of(const CLI::App& call);

/// Arguments, options and examples of a call; without a parent, the overview of the program.
/// @param width  columns that a line may have; examples are never broken
std::string help_of(const CLI::App& call, std::size_t width);

/// Columns of the terminal, from 40 to 120: longer lines are hard to read.
std::size_t help_width();

} // namespace listric
