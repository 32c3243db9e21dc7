// Options that several calls share.

#include "apps/commands/command.hpp"
#include "apps/scene/accuracy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <thread>

namespace listric {

int all_threads() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

std::vector<std::string> accuracy_names() {
    std::vector<std::string> names;
    for (const AccuracyLevel& level : accuracy_levels())
        names.emplace_back(level.name);
    return names;
}

CLI::Option* add_threads(CLI::App& command, int& threads) {
    return command.add_option("--threads", threads, "Processor cores to use")
        ->check(CLI::Range(1, 1024));
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
