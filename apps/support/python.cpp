#include "apps/support/python.hpp"

#include "apps/support/error.hpp"
#include "apps/support/log.hpp"
#include "apps/support/process.hpp"
#include "apps/support/resources.hpp"

#include <cstdlib>

namespace listric {

namespace {

/// Whether it is a Python with these modules.
bool has(const std::string& python, const std::vector<std::string>& modules) {
    std::vector<std::string> words{python, "-c",
                                   "import importlib.util as u, sys\n"
                                   "sys.exit(not all(map(u.find_spec, sys.argv[1:])))"};
    words.insert(words.end(), modules.begin(), modules.end());
    return run_program(words) == 0;
}

/// LISTRIC_PYTHON of the environment, else the first on PATH if it has the modules, else the
/// system's.
std::string find_python(const std::vector<std::string>& modules) {
    const char* wanted = std::getenv("LISTRIC_PYTHON");
    return wanted && *wanted ? wanted : has("python3", modules) ? "python3" : "/usr/bin/python3";
}

/// That draws.
const std::string& python() {
    static const std::string found = find_python({"numpy", "matplotlib"});
    return found;
}

/// Of a Python and one of the program's scripts.
std::vector<std::string> words_of(const std::string& python, const std::string& script,
                                  const std::vector<std::string>& arguments) {
    std::vector<std::string> words{python,
                                   (resource_folder() / "figures/python" / script).string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
}

} // namespace

std::string run_drawing_script(const std::string& script,
                               const std::vector<std::string>& arguments) {
    const int code = run_program(words_of(python(), script, arguments));
    return code == 0
               ? ""
               : "the drawing script failed (exit code " + std::to_string(code) + " of " +
                     python() + "; it needs numpy and matplotlib, LISTRIC_PYTHON names another)";
}

void draw_or_warn(const std::string& script, const std::vector<std::string>& arguments) {
    if (const std::string problem = run_drawing_script(script, arguments); !problem.empty())
        warn("no figure: " + problem);
}

void run_script_with(const std::string& module, const std::string& package,
                     const std::string& script, const std::vector<std::string>& arguments) {
    const std::vector<std::string> modules{"numpy", module};
    const std::string found = find_python(modules);
    if (!has(found, modules))
        throw UsageError(found + " has no module " + module + ": install the package " + package +
                         ", or name another Python in LISTRIC_PYTHON");
    if (const int code = run_program(words_of(found, script, arguments)); code != 0)
        throw StorageError(script + " failed (exit code " + std::to_string(code) + " of " + found +
                           ")");
}

} // namespace listric
