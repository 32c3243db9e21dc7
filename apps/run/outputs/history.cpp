#include "apps/archive/folder/summary.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/files/file.hpp"

namespace listric {

namespace {

void write_table(const RunView& run) {
    write_text(run.options.output / "history.csv", archive::to_csv(run.record.history));
}

/// Adds a row of measures to history.csv.
void add_row(RunView& run) {
    run.add_row();
    write_table(run);
    run.require_elasticity();
}

} // namespace

std::optional<Output> outputs::history(const RunView&) {
    return Output{
        .part = Part::measures, .begin = add_row, .resume = write_table, .window = add_row};
}

} // namespace listric
