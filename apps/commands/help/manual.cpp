#include "apps/commands/command.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>

#include <iostream>

// The manual's page of section 1, made from the declarations of calls and options.

namespace listric {

namespace {

constexpr std::pair<ExitCode, const char*> endings[] = {
    {ExitCode::done, "done"},
    {ExitCode::differs, "diff has found a difference"},
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

std::string section_of(const CLI::App& call) {
    std::string entries;
    for (const CLI::Option* option : call.get_options())
        if (option != call.get_help_ptr())
            entries += entry(head_of(*option), text_of(*option));
    return fmt::format(".SS listric {}\n{}.\n{}.PP\n.nf\n{}.fi\n", roff(usage_of(call)),
                       roff(call.get_description()), entries, roff(call.get_footer()));
}

std::string manual(const CLI::App& program) {
    std::string text = fmt::format(
        ".TH LISTRIC 1 \"\" \"listric {}\" \"User Commands\"\n"
        ".SH NAME\nlistric \\- numerical sandbox for halfgrabens\n"
        ".SH SYNOPSIS\n.B listric\n.I CALL\n[ARGUMENTS] [OPTIONS]\n"
        ".SH DESCRIPTION\nA hanging wall of bonded discs is pulled over "
        "a detachment; it breaks, bends and fills with sediment.\n"
        ".B listric CALL \\-\\-help\nprints arguments, options and examples of a call.\n"
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
    CLI::App* command = add_call(program, {"Shell",
                                           "manual",
                                           "print the manual's page, for man",
                                           "docs/reference/commands.md",
                                           {{{"manual > listric.1", "write the page"},
                                             {"manual | man -l -", "read the page"},
                                             {"manual | groff -man -Tpdf", "the page as PDF"}}}});
    return {command, [&program] {
                std::cout << manual(program);
                return ExitCode::done;
            }};
}

} // namespace listric
