#include "apps/commands/start_ranks.hpp"

#include "apps/archive/folder/run_folder.hpp"
#include "apps/commands/signals.hpp"
#include "apps/run/forecast/hints.hpp"
#include "apps/run/ranks/rank_reports.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/process.hpp"
#include "apps/support/machine/resources.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace listric {

namespace fs = std::filesystem;

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

/// Variables that another mpirun has left would mislead this one. It adds nothing to our
/// messages: its option for that has gone with Open MPI 5, these variables trouble neither.
void prepare_environment() {
    std::vector<std::string> names;
    const bool has_been_started = std::getenv("PMIX_RANK") || std::getenv("OMPI_COMM_WORLD_RANK");
    for (char** entry = environ; has_been_started && *entry; ++entry) {
        const std::string_view variable(*entry);
        for (const std::string_view begin :
             {"OMPI_COMM_WORLD_", "OMPI_APP_CTX_", "OMPI_UNIVERSE_SIZE", "OMPI_MCA_orte_",
              "OMPI_MCA_ess", "OMPI_MCA_pmix", "PMIX_", "PMI_"})
            if (variable.starts_with(begin))
                names.emplace_back(variable.substr(0, variable.find('=')));
    }
    for (const std::string& name : names)
        unsetenv(name.c_str());
    setenv("OMPI_MCA_orte_execute_quiet", "1", 1);
    setenv("PRTE_MCA_prte_execute_quiet", "1", 1);
}

ExitCode code_after(int signal) {
    switch (signal) {
    case SIGSEGV:
    case SIGABRT:
    case SIGFPE:
    case SIGILL:
        return ExitCode::internal_error;
    case SIGBUS: // memory that ranks share had no place
        return ExitCode::storage_failed;
    default:
        return ExitCode::interrupted;
    }
}

/// Says what has ended the run, and how it goes on.
ExitCode tell_of_end(ExitCode code, const std::string& what, const fs::path& output) {
    const bool has_snapshot = !archive::list_snapshots(output).empty();
    tell({code, fmt::format("{}; all processes of the run have ended; {}", what,
                            has_snapshot ? resume_hint(output) : "nothing was saved before")});
    return code;
}

ExitCode end_of(int code, int count, const RankReports& ranks, const fs::path& output) {
    const int signal = code - 128;
    if (code < 0)
        throw MemoryError("no process can be started for mpirun");
    if (code == 127)
        throw UsageError(fmt::format("--ranks: there is no mpirun; install the package {}",
                                     is_installed() ? "listric-ranks" : "openmpi-bin"));
    // mpirun's own codes: of its options, and of what it cannot do, or has been told to end.
    const bool is_of_mpirun = code == 1 || code == 213;
    if (is_of_mpirun && !ranks.any())
        throw UsageError(fmt::format(
            "--ranks={0}: mpirun does not start {0} processes here; more than a machine has cores: "
            "mpirun --oversubscribe -n {0} listric run ...",
            count));
    // A process that is asked to stop before it listens is ended by that.
    if (signal == request_to_stop)
        return ExitCode::interrupted;
    if (!is_of_mpirun && signal <= 0)
        return static_cast<ExitCode>(code);
    if (const auto told = ranks.root_code(); told && *told != 0)
        return static_cast<ExitCode>(*told);
    if (is_of_mpirun)
        return tell_of_end(ExitCode::interrupted, "mpirun was interrupted", output);
    return tell_of_end(code_after(signal),
                       fmt::format("{} was ended by signal {} ({})",
                                   ranks.lost()
                                       ? fmt::format("process {} of {}", *ranks.lost(), count)
                                       : "a process that mpirun started",
                                   signal, strsignal(signal)),
                       output);
}

} // namespace

ExitCode start_ranks(int count, const fs::path& output) {
    std::vector<std::string> words = words_of_call();
    words[0] = fs::read_symlink("/proc/self/exe").string();
    const std::vector<std::string> mpirun{"mpirun", "-n", std::to_string(count)};
    words.insert(words.begin(), mpirun.begin(), mpirun.end());
    prepare_environment();
    RankReports ranks;
    const int process = begin_program(words);
    if (process > 0) {
        hand_on_signals(process);
        ranks.listen_until_end_of(process);
    }
    return end_of(end_of_program(process), count, ranks, output);
}

} // namespace listric
