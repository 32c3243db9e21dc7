#include "apps/commands/command.hpp"
#include "apps/laboratory/laboratory.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/accuracy.hpp"
#include "apps/scene/material_file.hpp"
#include "apps/scene/pieces.hpp"
#include "apps/scene/tables.hpp"
#include "apps/studies/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

// A script for bash, made from the declarations of calls and options.

namespace listric {

namespace {

using Words = std::vector<std::string>;

Words nothing() { return {}; }
Words scene_names() { return scenes.names(); }
Words material_names() { return materials.names(); }
Words shells() { return {"bash"}; }

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
                words.push_back(fmt::format("{}.{}=", table.name, parameter.key));
    return words;
}

/// The same of a material.
Words material_assignments() {
    Words words;
    for (const Parameter& parameter : material_parameters<>())
        words.push_back(fmt::format("material.{}=", parameter.key));
    for (const Parameter& parameter : bond_parameters<>())
        words.push_back(fmt::format("bonds.{}=", parameter.key));
    return words;
}

/// What follows an option, or stands as an argument.
struct Answer {
    std::string words; ///< separated by blanks
    bool files = false;

    auto operator<=>(const Answer&) const = default;
};

/// What the program's own checks do not tell of a text, by the name of its option or argument, if
/// need be with its call.
const std::map<std::string, std::pair<Words (*)(), bool>> texts{
    {"SCENE", {scene_names, true}},
    {"FILE", {scene_names, true}},
    {"scene", {scene_names, true}},
    {"accuracy", {accuracy_names, false}},
    {"MATERIAL", {material_names, true}},
    {"weakened", {material_names, true}},
    {"vice", {material_names, true}},
    {"TEST", {test_names, false}},
    {"NAME", {study_names, false}},
    {"SHELL", {shells, false}},
    {"without", {all_effect_names, false}},
    {"set", {assignments, false}},
    {"laboratory set", {material_assignments, false}},
    {"until", {nothing, false}},
    {"task", {nothing, false}},
    {"name", {nothing, false}},
    {"only", {nothing, false}}};

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

Answer answer_to(const CLI::App& call, const CLI::Option& option) {
    const std::string type = option.get_type_name(); // TEXT:{stress,force}
    if (!type.starts_with("TEXT"))
        return {};
    if (const auto brace = type.find('{'); brace != type.npos) {
        std::string words = type.substr(brace + 1, type.find('}') - brace - 1);
        std::ranges::replace(words, ',', ' ');
        return {words, false};
    }
    const std::string& name = option.get_single_name();
    auto known = texts.find(call.get_name() + " " + name);
    if (known == texts.end())
        known = texts.find(name);
    if (known == texts.end())
        return {"", true};
    return {fmt::format("{}", fmt::join(known->second.first(), " ")), known->second.second};
}

Words options_of(const CLI::App& call) {
    Words words;
    for (const CLI::Option* option : call.get_options())
        for (const std::string& name : option->get_lnames())
            words.push_back("--" + name);
    return words;
}

/// What follows the options of a call: patterns of the shell's case, by what they are answered
/// with.
void add_answers(const CLI::App& call, std::map<Answer, Words>& patterns) {
    for (const CLI::Option* option : call.get_options())
        if (!is_flag(*option))
            for (const std::string& name : option->get_lnames())
                patterns[answer_to(call, *option)].push_back(
                    fmt::format("{},--{}", call.get_name(), name));
}

/// What the arguments of a call may be, together.
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
        text += fmt::format(" words=\"{}\"", answer.words);
    if (answer.files)
        text += " files=yes";
    return text;
}

std::string bash_script(const CLI::App& program) {
    Words calls;
    std::map<Answer, Words> patterns;
    std::string arguments;
    for (const CLI::App* call : program.get_subcommands({})) {
        const std::string& name = call->get_name();
        calls.push_back(name);
        add_answers(*call, patterns);
        arguments +=
            fmt::format("        {0},-*) words=\"{1}\" ;;\n        {0},*){2} ;;\n", name,
                        fmt::join(options_of(*call), " "), assignment_of(arguments_of(*call)));
    }
    std::string answers;
    for (const auto& [answer, of] : patterns)
        answers += fmt::format("    {}){} ;;\n", fmt::join(of, " | "), assignment_of(answer));
    return fmt::format(R"(# Completion of listric in bash, made by `listric completion bash`.
_listric() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
    local call=${{COMP_WORDS[1]}} words= files=
    # bash takes --option=value apart.
    if [[ $word == "=" ]]; then
        word=
    elif [[ $before == "=" ]]; then
        before=${{COMP_WORDS[COMP_CWORD - 2]}}
    fi
    ((COMP_CWORD == 1)) && call= before=
    case $call,$before in
    ,) words="{} {}" ;;
{}    *)
        case $call,$word in
{}        esac
        ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    if [[ $files ]]; then
        mapfile -t -O ${{#COMPREPLY[@]}} COMPREPLY < <(compgen -f -- "$word")
        compopt -o filenames 2>/dev/null
    fi
    [[ ${{COMPREPLY[*]}} == *= ]] && compopt -o nospace 2>/dev/null
    return 0
}}
complete -F _listric listric
)",
                       fmt::join(calls, " "), fmt::join(options_of(program), " "), answers,
                       arguments);
}

} // namespace

Command add_completion(CLI::App& program) {
    CLI::App* command =
        add_call(program, {"Shell",
                           "completion",
                           "print a script with which a shell completes calls",
                           "docs/editors.md",
                           {{{"completion bash > listric.bash", "to source in ~/.bashrc"},
                             {"completion bash", "look at the script"},
                             {"help completion", "this text"}}}});
    const auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash")->required()->check(CLI::IsMember(shells()));
    return {command, [&program, shell] {
                std::cout << bash_script(program);
                return ExitCode::done;
            }};
}

} // namespace listric
