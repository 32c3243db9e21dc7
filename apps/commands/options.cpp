// Options that several calls share.

#include "apps/commands/command.hpp"
#include "apps/scene/accuracy.hpp"
#include "apps/support/cores.hpp"
#include "apps/support/log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <string>

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
            // What is no number, or out of range, is refused next.
            if (const int most = all_threads(); wanted > most && wanted <= most_threads) {
                warn(
                    fmt::format("--threads {}: here this program may use {} core{}, so {} thread{}",
                                text, most, most == 1 ? "" : "s", most, most == 1 ? "" : "s"));
                text = std::to_string(most);
            }
            return std::string();
        },
        "");
    return command.add_option("--threads", threads, "Processor cores to use")
        ->check(CLI::Range(1, most_threads))
        ->transform(no_more_than_cores);
}

void add_words(CLI::App& command, const char* option, std::vector<std::string>& words,
               const char* what) {
    command.add_option(option, words, what)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* add_numbers(CLI::App& command, const char* option, std::vector<double>& numbers,
                         const std::string& what) {
    return command.add_option(option, numbers, what)
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_scene(CLI::App& command, SceneRequest& request) {
    command.add_option("SCENE", request.scene, "Name of a scene (listric scenes) or a path")
        ->required();
    add_words(command, "--set", request.set, "table.key=value; repeatable");
    add_words(command, "--without", request.without, "Switch off the effect TABLE; repeatable");
    command.add_option("--accuracy", request.accuracy,
                       fmt::format("{}", fmt::join(accuracy_names(), ", ")));
    command.add_option("--seed", request.seed, "Seed of the packing and of everything random");
}

} // namespace listric
