#include "apps/support/process.hpp"

#include <sys/wait.h>
#include <unistd.h>

namespace listric {

int run_program(const std::vector<std::string>& words,
                const std::function<void(int process)>& begun) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
        // execvp does not write to its arguments; its type is older than const.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        setpgid(0, 0); // a terminal sends Ctrl-C to a group
        execvp(arguments[0], arguments.data());
        _exit(127);
    }
    if (child > 0 && begun)
        begun(child);
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) < 0)
        return -1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

} // namespace listric
