#include "apps/support/machine/process.hpp"

#include "apps/support/machine/stop.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined __linux__
#include <sys/prctl.h>
#endif

namespace listric {

namespace {

constexpr std::size_t most_said = 65536;

/// As execvp takes them; the words must outlive them.
std::vector<char*> pointers(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
        // execvp does not write to its arguments; its type is older than const.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    return arguments;
}

/// The parent must not have ended before this could be asked for.
void stop_with(pid_t parent) {
#if defined __linux__
    prctl(PR_SET_PDEATHSIG, request_to_stop);
#endif
    if (getppid() != parent)
        _exit(127);
}

pid_t begin(const std::vector<std::string>& words, bool stops_with_parent) {
    const std::vector<char*> arguments = pointers(words);
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

SilentEnd run_silently(const std::vector<std::string>& words) {
    const std::vector<char*> arguments = pointers(words);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return {};
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child == 0) {
        setpgid(0, 0);
        stop_with(parent);
        const int nothing = open("/dev/null", O_RDWR);
        dup2(nothing, STDIN_FILENO);
        dup2(nothing, STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        execvp(arguments[0], arguments.data());
        _exit(127);
    }
    close(ends[1]);
    SilentEnd end;
    char part[4096];
    for (ssize_t count = 0; child > 0;) {
        count = read(ends[0], part, sizeof part);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            break;
        end.said.append(part, static_cast<std::size_t>(count));
        if (end.said.size() > 2 * most_said)
            end.said.erase(0, end.said.size() - most_said);
    }
    close(ends[0]);
    end.code = end_of_program(child);
    return end;
}

} // namespace listric
