#include "apps/run/forecast/hints.hpp"

#include "apps/archive/folder/run_folder.hpp"
#include "apps/support/machine/shell.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace listric {

using namespace archive;

namespace {

namespace fs = std::filesystem;

/// How to run the scene of a folder.
std::string call_for(const fs::path& output) {
    const char* call = std::getenv("LISTRIC_CALL"); // how the launcher was called
    return fmt::format("{} run {}", call ? call : "listric",
                       shell_quoted((output / "scene.toml").string()));
}

} // namespace

std::string resume_hint(const fs::path& output) {
    return fmt::format("resume with: {} --output {} --resume", call_for(output),
                       shell_quoted(output.string()));
}

std::string last_good_state(const fs::path& output) {
    const auto snapshots = list_snapshots(output);
    return snapshots.empty() ? "it happened before the first snapshot"
                             : "the last good state is " + snapshots.back().string();
}

std::string retry_hint(const Scene& scene, const fs::path& output) {
    return fmt::format("resumed it would end the same way; a smaller time step or speed may help, "
                       "in a new run: {} --set cycle.time_step_safety={:g} --output {}; if not, "
                       "--set extension.speed_m_per_s={:g}",
                       call_for(output), 0.5 * scene.cycle.time_step_safety,
                       shell_quoted(output.string() + "-2"), 0.5 * scene.extension.speed);
}

} // namespace listric
