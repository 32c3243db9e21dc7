#include "apps/support/process.hpp"

#include "apps/support/stop.hpp"

#include <cerrno>
#include <sys/wait.h>
#include <unistd.h>

#if defined __linux__
#include <sys/prctl.h>
#endif

namespace listric {

namespace {

/// The parent must not have ended before this could be asked for.
void stop_with(pid_t parent) {
#if defined __linux__
    prctl(PR_SET_PDEATHSIG, request_to_stop);
#endif
    if (getppid() != parent)
        _exit(127);
}

pid_t begin(const std::vector<std::string>& words, bool stops_with_parent) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
        // execvp does not write to its arguments; its type is older than const.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child != 0)
        return child;
    setpgid(0, 0); // a terminal sends Ctrl-C to a group
    if (stops_with_parent)
        stop_with(parent);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

} // namespace

int run_program(const std::vector<std::string>& words) {
    return end_of_program(begin(words, false));
}

int begin_program(const std::vector<std::string>& words) { return begin(words, true); }

int end_of_program(int process) {
    int status = 0;
    if (process < 0)
        return -1;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
            return -1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

} // namespace listric
