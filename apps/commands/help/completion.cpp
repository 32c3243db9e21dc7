#include "apps/commands/command.hpp"
#include "apps/figures/sections/export_run.hpp"
#include "apps/laboratory/laboratory.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/parameters/material_file.hpp"
#include "apps/scene/toml/pieces.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/studies/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

// Scripts for bash, zsh and fish, made from the declarations of calls and options.

namespace listric {

namespace {

using Words = std::vector<std::string>;

Words nothing() { return {}; }
Words scene_names() { return scenes.names(); }

/// Those, and the plan that calls hand over.
Words scenes_and_plan() {
    Words names = scene_names();
    names.emplace_back("flexure");
    return names;
}

Words material_names() { return materials.names(); }
Words shells() { return {"bash", "zsh", "fish"}; }

Words test_names() {
    const auto tests = laboratory_tests();
    return {tests.begin(), tests.end()};
}

Words study_names() {
    Words names;
    for (const Study& study : studies())
        names.emplace_back(study.name);
    return names;
}

Words kind_names() {
    const auto kinds = export_kinds();
    return {kinds.begin(), kinds.end()};
}

Words all_effect_names() {
    Words names;
    for (const Effect* effect : program_effects())
        names.emplace_back(effect->name);
    return names;
}

/// "table.key=" of every parameter.
Words assignments() {
    Words words;
    for (const SceneTable& table : scene_tables(program_effects()))
        for (const auto* parameters : {&table.parameters, &table.source})
            for (const Parameter& parameter : *parameters)
                words.push_back(fmt::format("{}{}.{}=", table.name, table.is_array() ? ".0" : "",
                                            parameter.key));
    for (const Parameter& parameter : flexure_parameters())
        words.push_back(fmt::format("flexure.{}=", parameter.key));
    return words;
}

/// Assignments to a material.
Words material_assignments() {
    Words words;
    for (const Parameter& parameter : material_parameters<>())
        words.push_back(fmt::format("material.{}=", parameter.key));
    for (const Parameter& parameter : bond_parameters<>())
        words.push_back(fmt::format("bonds.{}=", parameter.key));
    for (const Parameter& parameter : pore_parameters())
        words.push_back(fmt::format("pores.{}=", parameter.key));
    return words;
}

Words call_names(const CLI::App& program) {
    Words names;
    for (const CLI::App* call : program.get_subcommands({}))
        names.push_back(call->get_name());
    return names;
}

/// Words after an option, or in an argument's place.
struct Answer {
    std::string words; ///< separated by blanks
    bool files = false;

    auto operator<=>(const Answer&) const = default;
};

/// Offers for a kind of value, if need be with its call. Of a kind that is not here any
/// value is one that nobody can guess.
const std::map<std::string, std::pair<Words (*)(), bool>> kinds{
    {"SCENE", {scene_names, true}},
    {"run SCENE", {scenes_and_plan, true}},
    {"explain SCENE", {scenes_and_plan, true}},
    {"check SCENE", {scenes_and_plan, true}},
    {"FILE", {nothing, true}},
    {"DIR", {nothing, true}},
    {"LEVEL", {accuracy_names, false}},
    {"MATERIAL", {material_names, true}},
    {"TEST", {test_names, false}},
    {"STUDY", {study_names, false}},
    {"KIND", {kind_names, false}},
    {"TABLE", {all_effect_names, false}},
    {"KEY=VALUE", {assignments, false}},
    {"laboratory KEY=VALUE", {material_assignments, false}}};

Answer answer_to(const CLI::App& call, const CLI::Option& option) {
    if (const Words choices = choices_of(option); !choices.empty())
        return {fmt::format("{}", fmt::join(choices, " ")), false};
    const std::string kind = kind_of(option);
    if (kind == "CALL")
        return {fmt::format("{}", fmt::join(call_names(*call.get_parent()), " ")), false};
    auto known = kinds.find(call.get_name() + " " + kind);
    if (known == kinds.end())
        known = kinds.find(kind);
    if (known == kinds.end())
        return {};
    return {fmt::format("{}", fmt::join(known->second.first(), " ")), known->second.second};
}

Words options_of(const CLI::App& call) {
    Words words;
    for (const CLI::Option* option : call.get_options())
        std::ranges::copy_if(names_of(*option), std::back_inserter(words),
                             [](const std::string& name) { return name.starts_with("--"); });
    return words;
}

/// Words after the options of a call: patterns of the shell's case, by what they are answered
/// with.
void add_answers(const CLI::App& call, std::map<Answer, Words>& patterns) {
    for (const CLI::Option* option : call.get_options())
        if (option->get_items_expected_max() > 0)
            for (const std::string& name : names_of(*option))
                patterns[answer_to(call, *option)].push_back(call.get_name() + "," + name);
}

/// Words that the arguments of a call may be, together.
Answer arguments_of(const CLI::App& call) {
    Answer all;
    for (const CLI::Option* option : call.get_options()) {
        if (!option->get_positional())
            continue;
        const Answer one = answer_to(call, *option);
        all.words += (all.words.empty() ? "" : " ") + one.words;
        all.files |= one.files;
    }
    return all;
}

std::string assignment_of(const Answer& answer) {
    std::string text;
    if (!answer.words.empty())
        text += fmt::format(" offers=\"{}\"", answer.words);
    if (answer.files)
        text += " files=yes";
    return text;
}

/// For bash and zsh: `offers` and `files` by `call`, the word `before` and the `word` itself.
std::string cases(const CLI::App& program) {
    std::map<Answer, Words> patterns;
    std::string arguments;
    for (const CLI::App* call : program.get_subcommands({})) {
        const std::string& name = call->get_name();
        add_answers(*call, patterns);
        arguments +=
            fmt::format("        {0},-*) offers=\"{1}\" ;;\n        {0},*){2} ;;\n", name,
                        fmt::join(options_of(*call), " "), assignment_of(arguments_of(*call)));
    }
    std::string answers;
    for (const auto& [answer, of] : patterns)
        answers += fmt::format("    {}){} ;;\n", fmt::join(of, " | "), assignment_of(answer));
    return fmt::format(R"(    case $call,$before in
    ,) offers="{} {}" ;;
{}    *)
        case $call,$word in
{}        esac
        ;;
    esac
)",
                       fmt::join(call_names(program), " "), fmt::join(options_of(program), " "),
                       answers, arguments);
}

std::string bash_script(const CLI::App& program) {
    return R"(# Completion of listric in bash, made by `listric completion bash`.
_listric() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local call=${COMP_WORDS[1]} offers= files=
    # bash takes --option=value apart.
    if [[ $word == "=" ]]; then
        word=
    elif [[ $before == "=" ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    ((COMP_CWORD == 1)) && call= before=
)" + cases(program) +
           R"(    mapfile -t COMPREPLY < <(compgen -W "$offers" -- "$word")
    if [[ $files ]]; then
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$word")
        compopt -o filenames 2>/dev/null
    fi
    [[ ${COMPREPLY[*]} == *= ]] && compopt -o nospace 2>/dev/null
    return 0
}
complete -F _listric listric
)";
}

std::string zsh_script(const CLI::App& program) {
    return R"(#compdef listric
# Completion of listric in zsh, made by `listric completion zsh`.
_listric() {
    local word=${words[CURRENT]} before=${words[CURRENT-1]} call=${words[2]} offers= files=
    if [[ $word == --*=* ]]; then
        before=${word%%=*}
        compset -P '*='
    fi
    ((CURRENT == 2)) && call= before=
)" + cases(program) +
           R"(    local -a list=(${=offers})
    compadd -S '' -- ${(M)list:#*=}
    compadd -- ${list:#*=}
    [[ -n $files ]] && _files
    return 0
}
# In a folder of fpath this is the function itself; sourced, it is registered.
if [[ $funcstack[1] == _listric ]]; then _listric "$@"; else compdef _listric listric; fi
)";
}

/// A text between quotes of fish, its first line.
std::string fish_quoted(std::string text) {
    text = text.substr(0, text.find('\n'));
    for (std::size_t at = 0; (at = text.find('\'', at)) != text.npos; at += 2)
        text.insert(at, 1, '\\');
    return fmt::format("'{}'", text);
}

std::string fish_script(const CLI::App& program) {
    std::string text = "# Completion of listric in fish, made by `listric completion fish`.\n"
                       "complete -c listric -f\n";
    const auto line = [&](const std::string& when, const std::string& what, const Answer& answer,
                          const std::string& doc) {
        text += fmt::format(
            "complete -c listric -n '{}'{}{}{} -d {}\n", when, what, answer.files ? " -F" : "",
            answer.words.empty() ? "" : " -a " + fish_quoted(answer.words), fish_quoted(doc));
    };
    for (const CLI::App* call : program.get_subcommands({})) {
        line("test (count (commandline -opc)) -eq 1", "", {call->get_name()},
             call->get_description());
        const std::string inside =
            fmt::format("string match -q {} -- (commandline -opc)[2]", call->get_name());
        for (const CLI::Option* option : call->get_options()) {
            std::string names;
            for (const std::string& name : names_of(*option))
                names += (name.starts_with("--") ? " -l " : " -s ") +
                         name.substr(name.find_first_not_of('-'));
            if (option->get_items_expected_max() > 0 && !names.empty())
                names += " -r";
            line(inside, names, answer_to(*call, *option), option->get_description());
        }
    }
    return text;
}

} // namespace

Command add_completion(CLI::App& program) {
    CLI::App* command = add_call(
        program, {"Shell",
                  "completion",
                  "print a script with which a shell completes calls",
                  "docs/guides/editors.md",
                  {{{"completion bash > listric.bash", "a script to source in ~/.bashrc"},
                    {"completion zsh > _listric", "a file for a folder of zsh's fpath"},
                    {"completion fish > listric.fish", "a file for ~/.config/fish/completions"}}}});
    const auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember(shells()));
    return {command, [&program, shell] {
                std::cout << (*shell == "bash"  ? bash_script(program)
                              : *shell == "zsh" ? zsh_script(program)
                                                : fish_script(program));
                return ExitCode::done;
            }};
}

} // namespace listric
