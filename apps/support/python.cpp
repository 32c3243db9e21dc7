#include "apps/support/python.hpp"

#include "apps/support/log.hpp"
#include "apps/support/resources.hpp"

#include <sys/wait.h>
#include <unistd.h>

namespace listric {

namespace {

/// Runs a program without a shell. Returns its exit code, or -1.
int run_program(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
        // execv does not write to its arguments; its type is older than const.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        // Ctrl-C is for the run, which finishes its picture first.
        setpgid(0, 0);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) < 0)
        return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

} // namespace

std::string run_drawing_script(const std::string& script,
                               const std::vector<std::string>& arguments) {
    std::vector<std::string> words{"/usr/bin/python3",
                                   (source_folder() / "apps/figures/python" / script).string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const int code = run_program(words);
    return code == 0 ? ""
                     : "the drawing script failed (exit code " + std::to_string(code) +
                           "; it needs /usr/bin/python3 with matplotlib)";
}

void draw_or_warn(const std::string& script, const std::vector<std::string>& arguments) {
    if (const std::string problem = run_drawing_script(script, arguments); !problem.empty())
        warn("no figure: " + problem);
}

} // namespace listric
