#include "apps/figures/paraview.hpp"

#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

namespace listric {

namespace {

/// The series for ParaView: the discs at every moment; the field below them where pictures are
/// drawn, for a file of it is larger.
class Paraview : public Output {
public:
    void begin(RunView& run) override { save(run); }

    void resume(RunView& run) override {
        save(run);
        if (run.is_drawn() && run.is_window_end())
            save_field(run);
    }

    void window(RunView& run) override {
        save(run);
        if (run.is_drawn())
            save_field(run);
    }

    void save(RunView& run) override {
        write_paraview(run.options.output, run.state(), run.simulation.base(), run.names(),
                       run.scene.extension.rate);
    }

private:
    static void save_field(RunView& run) {
        if (run.footwall)
            run.footwall->write(run.options.output, run.footwall->recover(run.state()),
                                run.names());
    }
};

} // namespace

std::unique_ptr<Output> outputs::paraview(const RunView& run) {
    return run.scene.output.series == SeriesFormat::paraview ? std::make_unique<Paraview>()
                                                             : nullptr;
}

} // namespace listric
