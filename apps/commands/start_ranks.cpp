#include "apps/commands/start_ranks.hpp"

#include "apps/commands/signals.hpp"
#include "apps/support/error.hpp"
#include "apps/support/file.hpp"
#include "apps/support/process.hpp"

#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace listric {

namespace {

/// The words of this process' call, the program's name first.
std::vector<std::string> words_of_call() {
    const std::string all = read_text("/proc/self/cmdline");
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = all.find('\0', begin);
        words.push_back(all.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

} // namespace

ExitCode start_ranks(int count) {
    std::vector<std::string> words = words_of_call();
    words[0] = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::vector<std::string> mpirun{"mpirun", "-q", "-n", std::to_string(count)};
    words.insert(words.begin(), mpirun.begin(), mpirun.end());
    const int code = run_program(words, hand_on_signals);
    if (code < 0)
        throw MemoryError("no process can be started for mpirun");
    if (code == 127)
        throw UsageError("--ranks: there is no mpirun; install openmpi-bin (Debian 12)");
    if (code == 1) // mpirun's own
        throw UsageError(fmt::format(
            "--ranks={0}: mpirun does not start {0} processes here; more than a machine has cores: "
            "mpirun --oversubscribe -n {0} listric run ...",
            count));
    // A process that is asked to stop before it listens is ended by that.
    return code == 128 + SIGUSR1 ? ExitCode::interrupted : static_cast<ExitCode>(code);
}

} // namespace listric
