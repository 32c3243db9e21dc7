// Options that several calls share.

#include "apps/commands/command.hpp"
#include "apps/scene/parameters/accuracy.hpp"
#include "apps/support/error.hpp"
#include "apps/support/machine/cores.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

namespace listric {

int all_threads() { return usable_cores(); }

std::vector<std::string> accuracy_names() {
    std::vector<std::string> names;
    for (const AccuracyLevel& level : accuracy_levels())
        names.emplace_back(level.name);
    return names;
}

CLI::Option* add_threads(CLI::App& command, int& threads) {
    constexpr int most_threads = 1024;
    // Threads wait for each other: without a core each they only wait longer.
    const CLI::Validator no_more_than_cores(
        [](std::string& text) {
            int wanted = 0;
            std::from_chars(text.data(), text.data() + text.size(), wanted);
            // The next check refuses words and numbers out of range.
            if (const int most = all_threads(); wanted > most && wanted <= most_threads) {
                warn(
                    fmt::format("--threads {}: here this program may use {} core{}, so {} thread{}",
                                text, most, most == 1 ? "" : "s", most, most == 1 ? "" : "s"));
                text = std::to_string(most);
            }
            return std::string();
        },
        "");
    return command.add_option("--threads", threads, "cores to use")
        ->type_name("N")
        ->default_str("all")
        ->check(CLI::Range(1, most_threads).description(""))
        ->transform(no_more_than_cores);
}

double parse_length(const std::string& option, const std::string& text) {
    const Length length = read_length(text);
    if (!length.objection.empty())
        throw UsageError(fmt::format("{} {}: {}", option, shown_start(text), length.objection));
    return length.metres;
}

namespace {

/// A number of a call, as those of files are.
CLI::Option* read_alike(CLI::Option* option) {
    const CLI::Validator number(
        [](std::string& word) {
            const auto value = parse_number(word);
            if (!value)
                return no_number(word);
            word = fmt::format("{}", *value);
            return std::string();
        },
        "");
    return option->check(number);
}

/// "5e10"
std::string short_number(double number) {
    std::string text = fmt::format("{:g}", number);
    if (const auto plus = text.find("e+"); plus != text.npos)
        text.erase(plus + 1, text[plus + 2] == '0' ? 2 : 1);
    return text;
}

} // namespace

CLI::Option* add_number(CLI::App& command, const char* option, double& number, const char* what) {
    return read_alike(command.add_option(option, number, what))
        ->type_name("NUMBER")
        ->default_str(short_number(number));
}

CLI::Option* add_number(CLI::App& command, const char* option, std::optional<double>& number,
                        const char* what) {
    return read_alike(command.add_option(option, number, what))->type_name("NUMBER");
}

CLI::Option* add_numbers(CLI::App& command, const char* option, std::vector<double>& numbers,
                         const std::string& what) {
    return read_alike(command.add_option(option, numbers, what))
        ->type_name("NUMBERS")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* add_lengths(CLI::App& command, const char* option, std::vector<double>& metres,
                         const std::string& what) {
    const CLI::Validator length(
        [](std::string& word) {
            const Length read = read_length(word);
            if (!read.objection.empty())
                return fmt::format("{}: {}", shown_start(word), read.objection);
            word = fmt::format("{}", read.metres);
            return std::string();
        },
        "");
    return command.add_option(option, metres, what)
        ->type_name("LENGTHS")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->transform(length);
}

void add_words(CLI::App& command, const char* option, const char* kind,
               std::vector<std::string>& words, const char* what) {
    command.add_option(option, words, what)
        ->type_name(kind)
        ->default_str("none")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_quiet(CLI::App& command, bool& quiet) {
    command.add_flag("-q,--quiet", quiet, "show no progress");
}

void add_many_runs(CLI::App& command, ManyRuns& request, const char* otherwise) {
    add_count(command, "-j,--jobs", request.jobs, "runs at a time", 1, 1024)
        ->default_str("cores over threads");
    request.jobs = 0;
    add_threads(command, request.threads)->default_str("1");
    add_output(command, request.output, otherwise);
}

void add_scene(CLI::App& command, SceneRequest& request) {
    command.add_option("SCENE", request.scene, "name of a scene (listric scenes), or a file")
        ->type_name("SCENE")
        ->required();
    add_words(command, "--set", "KEY=VALUE", request.set,
              "change a parameter, such as extension.distance_m=5000; repeatable");
    add_words(command, "--without", "TABLE", request.without,
              "switch off an effect, by the name of its table; repeatable");
    command
        .add_option("--accuracy", request.accuracy,
                    fmt::format("resolution: {}", fmt::join(accuracy_names(), ", ")))
        ->type_name("LEVEL")
        ->default_str("the scene's, or standard");
    command.add_option("--seed", request.seed, "seed of the packing and of everything random")
        ->type_name("N")
        ->default_str("the scene's, or 1");
}

} // namespace listric
