#include "apps/support/machine/python.hpp"

#include "apps/support/error.hpp"
#include "apps/support/machine/process.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>

namespace listric {

namespace {

/// Exit codes of scripts, as apps/figures/python/script.py has them; 127 is of no program, 1 of
/// Python itself: it cannot load the script, which may fit another Python or library.
constexpr int cannot_load = 1, bad_input = 2, no_room = 4, no_library = 69, no_program = 127,
              interrupted = 130;

/// A Python, and with which options it is called.
using Interpreter = std::vector<std::string>;

/// Those that may do, the best first: LISTRIC_PYTHON of the environment, else the first on PATH,
/// else the system's. Alone (-I), without the caller's variables, current folder and own packages,
/// which may not fit the system's; then with own packages, where only these have what is needed.
std::vector<Interpreter> interpreters() {
    const char* wanted = std::getenv("LISTRIC_PYTHON");
    const Interpreter alone{"-I", "-X", "utf8"}, with_own{"-E", "-X", "utf8"};
    std::vector<std::string> programs{"python3", "/usr/bin/python3"};
    if (wanted && *wanted)
        programs = {wanted};
    std::vector<Interpreter> all;
    for (const Interpreter& options : {alone, with_own})
        for (const std::string& program : programs) {
            all.push_back({program});
            all.back().insert(all.back().end(), options.begin(), options.end());
        }
    return all;
}

/// Whether it is a Python with these modules, as far as can be told without loading them.
bool has_modules(Interpreter python, const std::vector<std::string>& modules) {
    python.insert(python.end(), {"-c", "import importlib.util as u, sys\n"
                                       "sys.exit(not all(map(u.find_spec, sys.argv[1:])))"});
    python.insert(python.end(), modules.begin(), modules.end());
    return run_silently(python).code == 0;
}

/// The last line of what a script has said, without its own name.
std::string last_line(std::string text, const std::string& script) {
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    std::string line = text.substr(text.rfind('\n') + 1);
    if (line.starts_with(script + ": "))
        line.erase(0, script.size() + 2);
    return shown(line);
}

/// Throws what the end of a script means.
[[noreturn]] void refuse_end(const SilentEnd& end, const std::string& script,
                             const std::string& python) {
    const std::string said = last_line(end.said, script);
    if (end.code == interrupted)
        throw Interrupted();
    if (end.code < 0)
        throw StorageError(fmt::format("{}: no process for it can be started", script));
    if (end.code > 128)
        throw StorageError(fmt::format("{} was ended by signal {}, as it is where memory is short",
                                       script, end.code - 128));
    if (end.code == bad_input)
        throw UsageError(fmt::format("{}: {}", script, said));
    if (end.code == no_room)
        throw StorageError(fmt::format("{}: {}", script, said));
    throw std::runtime_error(fmt::format("{} of {} failed with exit code {}: {}", script, python,
                                         end.code, said.empty() ? "no message" : said));
}

/// Runs a script on the first interpreter that can load the modules.
void run_script(const std::vector<std::string>& modules, const std::string& packages,
                const std::string& script, const std::vector<std::string>& arguments) {
    // By module: the one that did, so that others are not tried again. Threads draw.
    static std::map<std::string, Interpreter> that_did;
    static std::mutex mutex;
    std::vector<Interpreter> candidates = interpreters();
    {
        const std::lock_guard lock(mutex);
        if (const auto known = that_did.find(modules.back()); known != that_did.end())
            candidates = {known->second};
    }
    std::string lacking;
    for (const Interpreter& python : candidates) {
        if (candidates.size() > 1 && !has_modules(python, modules))
            continue;
        std::vector<std::string> words = python;
        words.push_back((resource_folder() / "figures/python" / script).string());
        words.insert(words.end(), arguments.begin(), arguments.end());
        const SilentEnd end = run_silently(words);
        const bool is_last = &python == &candidates.back();
        if (end.code == no_library || end.code == no_program ||
            (end.code == cannot_load && !is_last)) {
            lacking = fmt::format(" ({}: {})", python[0], last_line(end.said, script));
            continue;
        }
        const std::lock_guard lock(mutex);
        that_did[modules.back()] = python;
        return end.code == 0 ? void() : refuse_end(end, script, python[0]);
    }
    throw UsageError(fmt::format("{} needs Python with {}, and {} has them not{}: install {}, or "
                                 "name another Python in LISTRIC_PYTHON",
                                 script, fmt::join(modules, " and "), shown(candidates.front()[0]),
                                 lacking, packages));
}

} // namespace

void run_drawing_script(const std::string& script, const std::vector<std::string>& arguments) {
    run_script({"numpy", "matplotlib"}, "python3-matplotlib", script, arguments);
}

void draw_or_warn(const std::string& script, const std::vector<std::string>& arguments) {
    try {
        run_drawing_script(script, arguments);
    } catch (const std::exception& error) {
        warn(std::string("no figure: ") + error.what());
    }
}

void run_script_with(const std::string& module, const std::string& package,
                     const std::string& script, const std::vector<std::string>& arguments) {
    run_script({"numpy", module}, package, script, arguments);
}

} // namespace listric
