// Help of all calls: words instead of a parser's types, every default, examples that parse.

#include "apps/commands/command.hpp"
#include "tests/places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

namespace listric::help_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Passages of a call's help that a stranger could not read, and those that are missing.
std::vector<std::string> objections_to(const CLI::App& call) {
    static const std::regex raw(R"(\b(INT|UINT|FLOAT|TEXT|BOOLEAN|ENUM|REQUIRED|SUBCOMMAND)\b|[{}])"
                                R"(|\(\d+x\)| in \[)");
    std::vector<std::string> found;
    for (const std::size_t width : {60, 80, 120}) {
        std::istringstream lines(help_of(call, width));
        for (std::string line; std::getline(lines, line);) {
            if (line.size() > width)
                found.push_back(std::to_string(width) + " columns: " + line);
            if (std::regex_search(line, raw))
                found.push_back("a parser's type: " + line);
        }
    }
    for (const CLI::Option* option : call.get_options())
        if (!kind_of(*option).empty() && !option->get_required() &&
            text_of(*option).find("(default: ") == std::string::npos)
            found.push_back("no default: " + head_of(*option));
    return found;
}

std::vector<std::string> call_names() {
    CLI::App program;
    const std::vector<Command> calls = add_calls(program);
    std::vector<std::string> names;
    for (const CLI::App* call : program.get_subcommands({}))
        names.push_back(call->get_name());
    return names;
}

TEST(Help, HasWordsAndEveryDefaultInAllWidths) {
    CLI::App program("a program");
    const std::vector<Command> calls = add_calls(program);
    EXPECT_THAT(objections_to(program), IsEmpty());
    for (const CLI::App* call : program.get_subcommands({}))
        EXPECT_THAT(objections_to(*call), IsEmpty()) << call->get_name();
}

TEST(Help, OptionAsTheParserShowsItIsFound) {
    CLI::App program;
    CLI::App* call = add_call(program, {"Run", "walk", "walk a way", "docs/index.md", {}});
    double length = 0.0;
    int steps = 0;
    call->add_option("--length", length, "of the way")->default_str("none");
    EXPECT_EQ(objections_to(*call).size(), 3U); // FLOAT, at three widths
    call->add_option("--steps", steps, "to go")->type_name("N");
    EXPECT_EQ(objections_to(*call).size(), 4U); // no default
}

TEST(Help, EveryCallHasThreeExamplesThatParseAndADocument) {
    for (const std::string& name : call_names()) {
        CLI::App declared;
        const std::vector<Command> calls = add_calls(declared);
        const CLI::App* call = declared.get_subcommand(name);
        const std::vector<std::string> examples = example_calls(*call);
        EXPECT_EQ(examples.size(), 3U) << name;
        EXPECT_EQ(examples[0].find("listric " + name), 0U) << examples[0];
        for (const std::string& example : examples) {
            CLI::App program;
            const std::vector<Command> own = add_calls(program);
            const std::string words = example.substr(8, example.find_first_of("|>") - 8);
            try {
                program.parse(words);
            } catch (const CLI::CallForHelp&) {
            } catch (const CLI::Error& error) {
                ADD_FAILURE() << example << ": " << error.what();
            }
        }
        const std::string footer = call->get_footer();
        const std::string page = footer.substr(footer.find("Documents: ") + 11);
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(source_folder) /
                                            page.substr(0, page.find('\n'))))
            << page;
    }
}

TEST(Help, OverviewHasEveryCallInItsGroup) {
    CLI::App program("a program");
    const std::vector<Command> calls = add_calls(program);
    std::istringstream lines(help_of(program, 80));
    std::vector<std::string> groups, names;
    std::string heading;
    for (std::string line; std::getline(lines, line);)
        if (!line.empty() && line[0] != ' ')
            heading = line;
        else if (line.empty() || heading == "Options" || heading == "Examples")
            continue;
        else {
            if (groups.empty() || groups.back() != heading)
                groups.push_back(heading);
            names.push_back(line.substr(2, line.find(' ', 2) - 2));
        }
    EXPECT_THAT(groups, ElementsAre("Run", "Look", "Many runs", "Rock", "Shell"));
    EXPECT_EQ(names, call_names());
}

TEST(Help, BreaksBetweenWordsAndKeepsADefaultTogether) {
    CLI::App program;
    CLI::App* call = add_call(program, {"Run", "walk", "walk a way", "docs/index.md", {}});
    int steps = 100;
    add_count(*call, "-s,--steps", steps, "steps to go on a way of some length");
    EXPECT_THAT(help_of(*call, 60),
                HasSubstr("  -s, --steps N  steps to go on a way of some length\n"
                          "                 (default: 100)\n"));
    EXPECT_THAT(help_of(*call, 120), HasSubstr("some length (default: 100)\n"));
    EXPECT_THAT(help_of(*call, 60), Not(HasSubstr(" \n")));
}

} // namespace
} // namespace listric::help_test
