#include "apps/run/ranks/join_ranks.hpp"

#include "apps/support/error.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/words/text.hpp"
#include "fem/plugin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#ifndef LISTRIC_RANKS_PLUGIN
#define LISTRIC_RANKS_PLUGIN ""
#endif

namespace listric {

namespace fs = std::filesystem;

namespace {

using JoinRanks = dem::Ranks* (*)();

std::string text_of(const char* name) {
    const char* text = std::getenv(name);
    return text ? text : "";
}

/// A whole number; -1 if it is none.
int number_of(const std::string& text) {
    int number = -1;
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stopped == end ? number : -1;
}

JoinRanks load_plugin(const Launch& launch) {
    const LoadedPlugin plugin = load({.variable = "LISTRIC_RANKS_PLUGIN",
                                      .installed = LISTRIC_RANKS_INSTALLED,
                                      .built = LISTRIC_RANKS_PLUGIN,
                                      .entry = LISTRIC_RANKS_ENTRY});
    if (!plugin.problem.empty())
        throw UsageError(fmt::format(
            "{} processes were started together, but the plug-in for runs over MPI cannot be "
            "loaded ({}); {}, or start one, by --ranks=1",
            launch.count, plugin.problem,
            is_installed() ? "install the package listric-ranks, or libopenmpi-dev openmpi-bin "
                             "petsc-dev where you build it yourself, and build again"
                           : "install libopenmpi-dev openmpi-bin petsc-dev and build again"));
    if (!plugin.entry)
        throw UsageError(plugin.file +
                         ": is no plug-in for runs over MPI of this build; build again");
    return reinterpret_cast<JoinRanks>(plugin.entry);
}

} // namespace

Launch read_launch() {
    // Names of Open MPI's mpirun, of launchers that speak PMI, and of srun.
    constexpr const char* names[][2] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                        {"PMI_SIZE", "PMI_RANK"},
                                        {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};
    for (const auto& [count, mine] : names) {
        const std::string all = text_of(count), own = text_of(mine);
        if (all.empty() || own.empty())
            continue;
        const Launch launch{number_of(all), number_of(own)};
        if (launch.mine < 0 || launch.mine >= launch.count)
            throw UsageError(fmt::format("the environment has {}={} and {}={}, which no mpirun or "
                                         "srun sets; unset them, or --ranks=1 for one process",
                                         count, shown(all), mine, shown(own)));
        return launch;
    }
    return {};
}

void let_root_tell(int argc, const char* const* argv) {
    const std::vector<std::string_view> words(argv, argv + argc);
    if (words.size() < 2 || words[1] != "run" || std::ranges::count(words, "--ranks=1") > 0)
        return;
    try {
        if (read_launch().mine == 0)
            return;
    } catch (const UsageError&) {
        // the number that it has cannot be relied on
    }
    std::this_thread::sleep_for(std::chrono::seconds(2));
}

std::unique_ptr<dem::Ranks> join_ranks(const Launch& launch) {
    // MPI would end the process for it, with words about its own.
    const std::string folder = text_of("PMIX_SERVER_TMPDIR");
    std::error_code error;
    if (!folder.empty() && !fs::exists(folder, error))
        throw UsageError(fmt::format("the environment is of an mpirun that has ended "
                                     "(PMIX_SERVER_TMPDIR={} is gone): start the processes with "
                                     "another, or --ranks=1 makes the run in one",
                                     shown(folder)));
    std::unique_ptr<dem::Ranks> ranks(load_plugin(launch)());
    if (ranks->count() < launch.count)
        throw UsageError(fmt::format(
            "{} processes were started together, of which MPI knows {}; start them with mpirun, or "
            "with srun --mpi=pmix where SLURM has it; --ranks=1 makes the run in one process",
            launch.count, ranks->count()));
    return ranks;
}

} // namespace listric
