#include "apps/commands/help/help.hpp"

#include "apps/support/words/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>

namespace listric {

namespace {

constexpr std::string_view before_call = "    listric ";

/// The words of a text; "(default: 5)" counts as one where it fits into a line.
std::vector<std::string> words_of(std::string_view text, std::size_t room) {
    std::vector<std::string> words;
    std::istringstream rest{std::string(text)};
    for (std::string word; rest >> word;)
        if (!words.empty() && words.back() == "(default:" && 10 + word.size() <= room)
            words.back() += " " + word;
        else
            words.push_back(word);
    return words;
}

/// Breaks a text between words; its lines begin at `indent`, the first one after `head` or below.
std::string wrapped(std::string head, std::string_view text, std::size_t indent,
                    std::size_t width) {
    const std::string margin(indent, ' ');
    std::string out;
    if (head.size() + 2 > indent && !text.empty())
        out += std::exchange(head, "") + (indent > 0 ? "\n" : "");
    std::string line = head + margin.substr(std::min(head.size(), indent));
    for (bool is_first = true; const std::string& word : words_of(text, width - indent)) {
        if (!is_first && line.size() + 1 + word.size() > width)
            out += std::exchange(line, margin) + '\n';
        else if (!is_first)
            line += ' ';
        line += word;
        is_first = false;
    }
    return out + line + '\n';
}

struct Entry {
    std::string head, text;
};

/// Entries in two columns; of narrow terminals, texts below their heads.
std::string two_columns(const std::vector<Entry>& entries, std::size_t width) {
    std::size_t indent = 0;
    for (const Entry& entry : entries)
        indent = std::max(indent, entry.head.size() + 4);
    indent = std::min(indent, std::max<std::size_t>(6, width * 2 / 5));
    std::string text;
    for (const Entry& entry : entries) {
        std::string head = "  " + entry.head;
        for (const std::string& line : CLI::detail::split(entry.text, '\n'))
            text += wrapped(std::exchange(head, ""), line, indent, width);
    }
    return text;
}

std::string section(const char* heading, const std::vector<Entry>& entries, std::size_t width) {
    return entries.empty() ? "" : fmt::format("\n{}\n{}", heading, two_columns(entries, width));
}

std::vector<Entry> entries_of(const CLI::App& call, bool arguments) {
    std::vector<Entry> entries;
    for (const CLI::Option* option : call.get_options())
        if (option->get_positional() == arguments)
            entries.push_back({head_of(*option), text_of(*option)});
    if (!arguments) // help last
        std::rotate(entries.begin(), entries.begin() + 1, entries.end());
    return entries;
}

/// The footer, with the program's name as it was called.
std::string footer_of(const CLI::App& call) {
    const char* name = std::getenv("LISTRIC_CALL");
    std::string text = call.get_footer();
    for (std::size_t at = 0; name && (at = text.find(before_call, at)) != text.npos; ++at)
        text.replace(at, before_call.size(), fmt::format("    {} ", name));
    return text;
}

std::string overview(const CLI::App& program, std::size_t width) {
    std::string text =
        program.get_description() + "\n\nusage: listric CALL [ARGUMENTS] [OPTIONS]\n";
    std::vector<std::string> groups;
    for (const CLI::App* call : program.get_subcommands({}))
        if (std::ranges::find(groups, call->get_group()) == groups.end())
            groups.push_back(call->get_group());
    std::size_t longest = 0;
    for (const CLI::App* call : program.get_subcommands({}))
        longest = std::max(longest, call->get_name().size());
    for (const std::string& group : groups) {
        std::vector<Entry> entries;
        for (const CLI::App* call : program.get_subcommands({}))
            if (call->get_group() == group)
                entries.push_back(
                    {fmt::format("{:<{}}", call->get_name(), longest), call->get_description()});
        text += section(group.c_str(), entries, width);
    }
    return text + section("Options", entries_of(program, false), width) + '\n' + footer_of(program);
}

} // namespace

CLI::App* add_call(CLI::App& program, const CallHelp& help) {
    CLI::App* call = program.add_subcommand(help.name, help.purpose);
    call->group(help.group);
    std::string footer = "Examples\n";
    for (const Example& example : help.examples)
        if (example.call)
            footer += fmt::format("  {}\n{}{}\n", example.purpose, before_call, example.call);
    call->footer(footer + fmt::format("\nDocuments: {}\n", help.page));
    return call;
}

std::vector<std::string> example_calls(const CLI::App& call) {
    std::vector<std::string> calls;
    std::istringstream lines(call.get_footer());
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(before_call))
            calls.push_back(line.substr(4));
    return calls;
}

std::string kind_of(const CLI::Option& option) {
    const std::string type = option.get_type_name(); // LEVEL:{draft,standard}
    return type.substr(0, type.find(':'));
}

std::vector<std::string> choices_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const auto from = type.find('{'), to = type.find('}');
    return from == type.npos ? std::vector<std::string>()
                             : CLI::detail::split(type.substr(from + 1, to - from - 1), ',');
}

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

std::string head_of(const CLI::Option& option) {
    if (option.get_positional()) {
        const std::string& name = option.get_name();
        const std::string once = option.get_required() ? name : "[" + name + "]";
        return option.get_items_expected_max() == 2  ? once + " [" + name + "]"
               : option.get_items_expected_max() > 2 ? once + "..."
                                                     : once;
    }
    const std::string kind = kind_of(option);
    const char* form = option.get_items_expected_max() == 0 ? "[={}]" : " {}";
    return CLI::detail::join(names_of(option), ", ") +
           (kind.empty() ? "" : fmt::format(fmt::runtime(form), kind));
}

std::string text_of(const CLI::Option& option) {
    const std::string& value = option.get_default_str();
    return option.get_description() + (value.empty() ? "" : fmt::format(" (default: {})", value));
}

std::string usage_of(const CLI::App& call) {
    std::string text = call.get_name();
    for (const CLI::Option* option : call.get_options())
        if (option->get_positional())
            text += " " + head_of(*option);
    return text;
}

std::string help_of(const CLI::App& call, std::size_t width) {
    if (!call.get_parent())
        return overview(call, width);
    return wrapped("", fmt::format("listric {}: {}", call.get_name(), call.get_description()), 0,
                   width) +
           fmt::format("\nusage: listric {} [OPTIONS]\n", usage_of(call)) +
           section("Arguments", entries_of(call, true), width) +
           section("Options", entries_of(call, false), width) + '\n' + footer_of(call);
}

std::size_t help_width() {
    constexpr std::size_t least = 40, most = 120;
    return std::clamp(terminal_columns(), least, most);
}

} // namespace listric
