#include "apps/commands/command.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>

#include <iostream>

// The manual's page of section 1, made from the declarations of calls and options.

namespace listric {

namespace {

constexpr std::pair<ExitCode, const char*> endings[] = {
    {ExitCode::done, "done"},
    {ExitCode::bad_call, "the call or the scene is wrong; the message names file, line, what is "
                         "allowed"},
    {ExitCode::numerics_failed, "the numbers went wrong; the message names the moment"},
    {ExitCode::storage_failed, "no room: a file that cannot be written, or memory"},
    {ExitCode::internal_error, "our own mistake, to be reported"},
    {ExitCode::interrupted, "interrupted; what was reached is saved"}};

/// Text as roff prints it: hyphens stay hyphens, no line is a request, lines stay lines.
std::string roff(std::string_view text) {
    std::string out;
    for (const char letter : text) {
        if (letter == '-')
            out += "\\-";
        else if (letter == '\\')
            out += "\\e";
        else if (letter == '\n')
            out += "\n.br\n";
        else if ((letter == '.' || letter == '\'') && (out.empty() || out.back() == '\n'))
            out += fmt::format("\\&{}", letter);
        else
            out += letter;
    }
    return out;
}

std::string entry(std::string_view head, std::string_view text) {
    return fmt::format(".TP\n.B {}\n{}\n", roff(head), roff(text));
}

/// "--accuracy TEXT", or an argument's name.
std::string head_of(const CLI::Option& option) {
    std::string head = option.get_name(true, true);
    if (const std::string type = option.get_type_name();
        option.get_items_expected_max() > 0 && !option.get_positional())
        head += " " + type.substr(0, type.find(':'));
    return head;
}

std::string section_of(const CLI::App& call) {
    std::string arguments, entries;
    for (const CLI::Option* option : call.get_options()) {
        if (option->get_positional())
            arguments += " " + option->get_name();
        if (option != call.get_help_ptr())
            entries += entry(head_of(*option), option->get_description());
    }
    return fmt::format(".SS {}\n{}.\n{}",
                       roff(fmt::format("listric {}{}", call.get_name(), arguments)),
                       roff(call.get_description()), entries);
}

std::string manual(const CLI::App& program) {
    std::string text = fmt::format(".TH LISTRIC 1 \"\" \"listric {}\" \"User Commands\"\n"
                                   ".SH NAME\nlistric \\- numerical sandbox for halfgrabens\n"
                                   ".SH SYNOPSIS\n.B listric\n.I CALL\n[ARGUMENTS] [OPTIONS]\n"
                                   ".SH DESCRIPTION\nA hanging wall of bonded discs is pulled over "
                                   "a detachment; it breaks, bends and fills with sediment.\n"
                                   ".B listric CALL \\-\\-help\nsays what a call takes.\n"
                                   ".SH CALLS\n",
                                   roff(version));
    for (const CLI::App* call : program.get_subcommands({}))
        text += section_of(*call);
    text += ".SH EXIT STATUS\n";
    for (const auto& [code, meaning] : endings)
        text += entry(std::to_string(static_cast<int>(code)), meaning);
    return text;
}

} // namespace

Command add_manual(CLI::App& program) {
    return {program.add_subcommand("manual", "The manual's page, for man"), [&program] {
                std::cout << manual(program);
                return ExitCode::done;
            }};
}

} // namespace listric
