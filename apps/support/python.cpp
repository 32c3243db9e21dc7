#include "apps/support/python.hpp"

#include "apps/support/log.hpp"
#include "apps/support/resources.hpp"

#include <cstdlib>
#include <sys/wait.h>
#include <unistd.h>

namespace listric {

namespace {

/// Runs a program, by its path or found on PATH, without a shell. Returns its exit code, or -1.
int run_program(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
        // execvp does not write to its arguments; its type is older than const.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        // Ctrl-C is for the run, which finishes its picture first.
        setpgid(0, 0);
        execvp(arguments[0], arguments.data());
        _exit(127);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) < 0)
        return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Whether it is a Python that can draw.
bool draws(const std::string& python) {
    return run_program({python, "-c",
                        "import importlib.util as u, sys\n"
                        "sys.exit(not all(map(u.find_spec, ('numpy', 'matplotlib'))))"}) == 0;
}

std::string find_python() {
    const char* wanted = std::getenv("LISTRIC_PYTHON");
    return wanted && *wanted ? wanted : draws("python3") ? "python3" : "/usr/bin/python3";
}

/// LISTRIC_PYTHON of the environment, else the first on PATH if it can draw, else the system's.
const std::string& python() {
    static const std::string found = find_python();
    return found;
}

} // namespace

std::string run_drawing_script(const std::string& script,
                               const std::vector<std::string>& arguments) {
    std::vector<std::string> words{python(),
                                   (resource_folder() / "figures/python" / script).string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const int code = run_program(words);
    return code == 0
               ? ""
               : "the drawing script failed (exit code " + std::to_string(code) + " of " +
                     python() + "; it needs numpy and matplotlib, LISTRIC_PYTHON names another)";
}

void draw_or_warn(const std::string& script, const std::vector<std::string>& arguments) {
    if (const std::string problem = run_drawing_script(script, arguments); !problem.empty())
        warn("no figure: " + problem);
}

} // namespace listric
