#include "apps/figures/sections/paraview.hpp"

#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

namespace listric {

namespace {

/// Writes the discs of the present moment.
void save_step(const RunView& run) {
    write_paraview(run.options.output, run.state(), run.simulation.base(), run.names(),
                   make_calendar(run.scene));
}

/// Where pictures are drawn, writes the field below the discs, too: a file of it is larger.
void save_window(const RunView& run) {
    save_step(run);
    if (!run.is_drawn() || !run.is_window_end())
        return;
    if (const fem::Footwall* footwall = run.footwall())
        write_footwall(run.options.output, *footwall, run.travel().m, run.names(),
                       make_calendar(run.scene));
}

} // namespace

std::optional<Output> outputs::paraview(const RunView& run) {
    if (run.scene.output.series != SeriesFormat::paraview || run.options.lean != Lean::no)
        return std::nullopt;
    return Output{
        .begin = save_step, .resume = save_window, .window = save_window, .save = save_step};
}

} // namespace listric
