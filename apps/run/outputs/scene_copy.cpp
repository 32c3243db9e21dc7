#include "apps/archive/scene_lines.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/file.hpp"

namespace listric {

namespace {

/// scene.toml: all parameters in force.
class SceneCopy : public Output {
public:
    void enter(RunView& run) override {
        if (run.phase == Phase::genesis)
            keep(run);
    }
    void resume(RunView& run) override { keep(run); }

private:
    /// Writes it, unless it is there and says the same.
    static void keep(const RunView& run) {
        const std::filesystem::path file = run.options.output / "scene.toml";
        if (archive::scene_lines(read_text_if_there(file)) !=
            archive::scene_lines(run.record.scene))
            write_text(file, run.record.scene);
    }
};

} // namespace

std::unique_ptr<Output> outputs::scene_copy(const RunView&) {
    return std::make_unique<SceneCopy>();
}

} // namespace listric
