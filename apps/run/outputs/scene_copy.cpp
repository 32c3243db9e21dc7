#include "apps/archive/folder/scene_lines.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/files/file.hpp"

namespace listric {

namespace {

/// Writes scene.toml, all parameters in force, unless it is there and says the same.
void keep_scene(const RunView& run) {
    const std::filesystem::path file = run.options.output / "scene.toml";
    if (archive::scene_lines(read_text_if_there(file)) != archive::scene_lines(run.record.scene))
        write_text(file, run.record.scene);
}

void enter(const RunView& run) {
    if (run.phase == Phase::genesis)
        keep_scene(run);
}

} // namespace

std::optional<Output> outputs::scene_copy(const RunView&) {
    return Output{.enter = enter, .resume = keep_scene};
}

} // namespace listric
