#include "apps/run/join_ranks.hpp"

#include "apps/support/error.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <string>

#ifndef LISTRIC_RANKS_PLUGIN
#define LISTRIC_RANKS_PLUGIN ""
#endif

namespace listric {

namespace fs = std::filesystem;

namespace {

using JoinRanks = dem::Ranks* (*)();

/// A whole number of the environment; -1 if there is none.
int number_of(const char* name) {
    const char* text = std::getenv(name);
    int number = -1;
    return text && std::from_chars(text, text + std::strlen(text), number).ec == std::errc()
               ? number
               : -1;
}

/// The environment's LISTRIC_RANKS_PLUGIN, else what is installed beside the program, else what was
/// built. Empty: there is none.
std::string find_plugin() {
    if (const char* path = std::getenv("LISTRIC_RANKS_PLUGIN"); path && *path)
        return path;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    for (const fs::path& file :
         {program.parent_path() / LISTRIC_RANKS_INSTALLED, fs::path(LISTRIC_RANKS_PLUGIN)})
        if (fs::is_regular_file(file, error))
            return file.string();
    return "";
}

JoinRanks load_plugin(const Launch& launch) {
    const std::string file = find_plugin();
    void* library = file.empty() ? nullptr : dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
        throw UsageError(fmt::format(
            "{} processes were started together, but the plug-in for runs over MPI cannot be "
            "loaded ({}); install libopenmpi-dev openmpi-bin petsc-dev (Debian 12) and build "
            "again, or start one",
            launch.count, file.empty() ? "it was not built" : dlerror()));
    const auto join = reinterpret_cast<JoinRanks>(dlsym(library, LISTRIC_RANKS_ENTRY));
    if (!join)
        throw UsageError(file + ": is no plug-in for runs over MPI of this build; build again");
    return join;
}

} // namespace

Launch read_launch() {
    // Of Open MPI's mpirun, of those that speak PMI, and of srun.
    constexpr const char* names[][2] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                        {"PMI_SIZE", "PMI_RANK"},
                                        {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};
    for (const auto& [count, mine] : names)
        if (number_of(count) > 0 && number_of(mine) >= 0)
            return {number_of(count), number_of(mine)};
    return {};
}

std::unique_ptr<dem::Ranks> join_ranks(const Launch& launch) {
    std::unique_ptr<dem::Ranks> ranks(load_plugin(launch)());
    if (ranks->count() < launch.count)
        throw UsageError(fmt::format(
            "{} processes were started together, of which MPI knows {}; start them with mpirun, or "
            "with srun --mpi=pmix where SLURM has it",
            launch.count, ranks->count()));
    return ranks;
}

} // namespace listric
