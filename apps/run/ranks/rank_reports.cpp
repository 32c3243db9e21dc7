#include "apps/run/ranks/rank_reports.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace listric {

namespace {

constexpr const char* variable = "LISTRIC_RANK_REPORTS";

/// A report: written and read as a whole, for it is shorter than a pipe's atomic writes are.
struct RankReport {
    int rank, process;
    int code; ///< -1: it begins
};

/// A descriptor that is readable once a process has ended; -1 where there is no such thing.
int watch_of(int process) {
#if defined SYS_pidfd_open
    return static_cast<int>(syscall(SYS_pidfd_open, process, 0));
#else
    static_cast<void>(process);
    return -1;
#endif
}

void report(const RankReport& said) {
    const char* pipe = std::getenv(variable);
    const int to = pipe && *pipe ? open(pipe, O_WRONLY | O_NONBLOCK | O_CLOEXEC) : -1;
    if (to < 0)
        return;
    struct stat what {};
    if (fstat(to, &what) == 0 && S_ISFIFO(what.st_mode) &&
        ::write(to, &said, sizeof said) != sizeof said) {
        // nobody listens any more
    }
    close(to);
}

bool is_ready(int descriptor) {
    pollfd look{descriptor, POLLIN, 0};
    return poll(&look, 1, 0) == 1;
}

/// Whether a process of this one has ended; it is not waited for.
bool has_ended(int process) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid != 0;
}

} // namespace

RankReports::RankReports() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
        return; // then mpirun's exit code has to do
    read_ = ends[0];
    write_ = ends[1];
    setenv(variable, fmt::format("/proc/{}/fd/{}", getpid(), write_).c_str(), 1);
}

RankReports::~RankReports() {
    unsetenv(variable);
    for (const auto& [number, rank] : ranks_)
        if (rank.watch >= 0)
            close(rank.watch);
    if (read_ >= 0) {
        close(read_);
        close(write_);
    }
}

std::optional<int> RankReports::root_code() const {
    const auto root = ranks_.find(0);
    return root == ranks_.end() ? std::nullopt : root->second.code;
}

void RankReports::hear() {
    for (RankReport said{}; read_ >= 0 && ::read(read_, &said, sizeof said) == sizeof said;) {
        Rank& rank = ranks_[said.rank];
        if (said.code >= 0)
            rank.code = said.code;
        else if (rank.watch < 0)
            rank.watch = watch_of(said.process);
    }
}

void RankReports::look_for_ended() {
    for (auto& [number, rank] : ranks_) {
        if (rank.watch < 0 || !is_ready(rank.watch))
            continue;
        close(std::exchange(rank.watch, -1));
        hear(); // it may have said so
        if (!rank.code && !lost_)
            lost_ = number;
    }
}

void RankReports::listen_until_end_of(int process) {
    const int end = watch_of(process);
    while (!has_ended(process)) {
        std::vector<pollfd> all{{end, POLLIN, 0}, {read_, POLLIN, 0}};
        for (const auto& [number, rank] : ranks_)
            all.push_back({rank.watch, POLLIN, 0});
        poll(all.data(), all.size(), end < 0 ? 100 : -1);
        hear();
        look_for_ended();
    }
    hear();
    if (end >= 0)
        close(end);
}

void report_begin(int rank) { report({rank, getpid(), -1}); }

void report_end(int rank, int code) { report({rank, getpid(), code}); }

} // namespace listric
