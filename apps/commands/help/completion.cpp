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
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <span>

// What shells offer for the words of a call, from the declarations of calls and options, and the
// scripts with which bash, zsh and fish ask for it.

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

Words names_in(const auto& things, auto name) {
    Words names;
    for (const auto& thing : things)
        names.emplace_back(std::invoke(name, thing));
    return names;
}

Words test_names() { return names_in(laboratory_tests(), std::identity{}); }
Words study_names() { return names_in(studies(), &Study::name); }
Words kind_names() { return names_in(export_kinds(), std::identity{}); }
Words all_effect_names() { return names_in(program_effects(), &Effect::name); }

void add_keys(Words& words, const std::string& table, const auto& parameters) {
    for (const auto& parameter : parameters)
        words.push_back(fmt::format("{}.{}=", table, parameter.key));
}

/// "table.key=" of every parameter.
Words assignments() {
    Words words;
    for (const SceneTable& table : scene_tables(program_effects()))
        for (const auto* parameters : {&table.parameters, &table.source})
            add_keys(words, fmt::format("{}{}", table.name, table.is_array() ? ".0" : ""),
                     *parameters);
    add_keys(words, "flexure", flexure_parameters());
    return words;
}

/// Assignments to a material.
Words material_assignments() {
    Words words;
    add_keys(words, "material", material_parameters<>());
    add_keys(words, "bonds", bond_parameters<>());
    add_keys(words, "pores", pore_parameters());
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
    Words words;
    bool files = false;
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
        return {choices};
    const std::string kind = kind_of(option);
    if (kind == "CALL")
        return {call_names(*call.get_parent())};
    auto known = kinds.find(call.get_name() + " " + kind);
    if (known == kinds.end())
        known = kinds.find(kind);
    return known == kinds.end() ? Answer{} : Answer{known->second.first(), known->second.second};
}

/// A word of the program with its purpose, as fish shows them.
std::string described(const std::string& word, const std::string& purpose) {
    return fmt::format("{}\t{}", word, purpose.substr(0, purpose.find('\n')));
}

Words options_of(const CLI::App& call) {
    Words words;
    for (const CLI::Option* option : call.get_options())
        for (const std::string& name : names_of(*option))
            if (name.starts_with("--"))
                words.push_back(described(name, option->get_description()));
    return words;
}

Answer first_words(const CLI::App& program) {
    Words words;
    for (const CLI::App* call : program.get_subcommands({}))
        words.push_back(described(call->get_name(), call->get_description()));
    std::ranges::copy(options_of(program), std::back_inserter(words));
    return {words};
}

/// What the option `name` of a call takes; none: it is no option that takes something.
std::optional<Answer> value_of(const CLI::App& call, const std::string& name) {
    for (const CLI::Option* option : call.get_options())
        if (option->get_items_expected_max() > 0 && std::ranges::count(names_of(*option), name) > 0)
            return answer_to(call, *option);
    return {};
}

/// What the arguments of a call may be, together.
Answer arguments_of(const CLI::App& call) {
    Answer all;
    for (const CLI::Option* option : call.get_options()) {
        if (!option->get_positional())
            continue;
        const Answer one = answer_to(call, *option);
        std::ranges::copy(one.words, std::back_inserter(all.words));
        all.files |= one.files;
    }
    return all;
}

/// What may stand in place of the last word, behind the others.
Answer answer(const CLI::App& program, std::span<const std::string> words) {
    if (words.size() < 2)
        return first_words(program);
    const auto calls = program.get_subcommands(
        [&](const CLI::App* call) { return call->get_name() == words.front(); });
    if (calls.empty())
        return {};
    const CLI::App* call = calls.front();
    if (auto value = value_of(*call, words[words.size() - 2]))
        return *value;
    return words.back().starts_with("-") ? Answer{options_of(*call)} : arguments_of(*call);
}

/// Scripts, with the program's name in place of PROGRAM.
constexpr std::string_view bash_script =
    R"(# Completion of listric in bash, made by `listric completion bash`.
_listric() {
    local word=${COMP_WORDS[COMP_CWORD]}
    mapfile -t COMPREPLY < <(PROGRAM complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
    COMPREPLY=("${COMPREPLY[@]%%$'\t'*}")
    if [[ ${COMPREPLY[0]-} == / ]]; then
        COMPREPLY=("${COMPREPLY[@]:1}")
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "${word#=}")
        compopt -o filenames 2>/dev/null
    fi
    [[ ${COMPREPLY[*]} == *= ]] && compopt -o nospace 2>/dev/null
    return 0
}
complete -F _listric listric
)";

constexpr std::string_view zsh_script =
    R"(#compdef listric
# Completion of listric in zsh, made by `listric completion zsh`.
_listric() {
    local -a offers=("${(@f)$(PROGRAM complete "${(@)words[2,CURRENT]}" 2>/dev/null)}")
    offers=(${offers%%$'\t'*})
    compadd -S '' -- ${(M)offers:#*=}
    compadd -- ${${offers:#*=}:#/}
    [[ $offers[1] == / ]] && { compset -P '--*='; _files }
    return 0
}
# In a folder of fpath this is the function itself; sourced, it is registered.
if [[ $funcstack[1] == _listric ]]; then _listric "$@"; else compdef _listric listric; fi
)";

constexpr std::string_view fish_script =
    R"(# Completion of listric in fish, made by `listric completion fish`.
function _listric_offers
    set -l word (commandline -ct)
    set -l before (commandline -opc)
    set -l offers (PROGRAM complete $before[2..] "$word" 2>/dev/null)
    if test "$offers[1]" = /
        set -e offers[1]
        __fish_complete_path "$word"
    end
    string join \n -- $offers
end
complete -c listric -f -a '(_listric_offers)'
)";

/// How a script calls the program, between quotes of all three shells: by the name of an
/// installation, else by its place.
std::string own_call() {
    const char* name = std::getenv("LISTRIC_CALL");
    std::string call = name && std::string_view(name) == "listric"
                           ? name
                           : std::filesystem::read_symlink("/proc/self/exe").string();
    for (std::size_t at = 0; (at = call.find('\'', at)) != call.npos; at += 4)
        call.replace(at, 1, "'\\''");
    return fmt::format("'{}'", call);
}

} // namespace

void print_offers(const CLI::App& program, std::vector<std::string> words) {
    // bash takes --option=value apart, others leave it together.
    std::string start;
    if (words.empty())
        words.emplace_back();
    if (words.back() == "=")
        words.back().clear();
    else if (const auto sign = words.back().find('=');
             words.back().starts_with("--") && sign != std::string::npos) {
        start = words.back().substr(0, sign + 1);
        words.push_back(words.back().substr(sign + 1));
        words[words.size() - 2].resize(sign);
    }
    std::erase(words, "=");
    const Answer all = answer(program, words);
    if (all.files)
        std::cout << "/\n"; // files, too
    for (const std::string& word : all.words)
        if (word.starts_with(words.back()))
            std::cout << start << word << '\n';
}

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
        ->check(CLI::IsMember(Words{"bash", "zsh", "fish"}));
    return {command, [shell] {
                const std::string_view script = *shell == "bash"  ? bash_script
                                                : *shell == "zsh" ? zsh_script
                                                                  : fish_script;
                const auto place = script.find("PROGRAM");
                std::cout << script.substr(0, place) << own_call() << script.substr(place + 7);
                return ExitCode::done;
            }};
}

} // namespace listric
