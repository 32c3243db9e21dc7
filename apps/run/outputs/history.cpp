#include "apps/archive/dictionary.hpp"
#include "apps/archive/summary.hpp"
#include "apps/model/model.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/file.hpp"

#include <limits>

namespace listric {

namespace {

void write_table(const RunView& run) {
    write_text(run.options.output / "history.csv", archive::to_csv(run.record.history));
}

/// Adds a row of measures to history.csv.
void add_row(RunView& run) {
    NamedNumbers row = archive::history_row(run.state(), run.measured());
    append(row, measure_effects(run.now()).numbers);
    append(row, run.window_of_base.measures);
    dem::Table& history = run.record.history;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [name, value] : row)
        if (!history.has(name))
            history.add<double>(name, archive::unit_of(name, run.scene), nan);
    history.resize(history.rows() + 1);
    for (const auto& [name, value] : row)
        history.get<double>(name).back() = value;
    write_table(run);
    if (run.window_of_base.beyond_elasticity)
        throw BeyondElasticity(*run.window_of_base.beyond_elasticity);
}

} // namespace

std::optional<Output> outputs::history(const RunView&) {
    return Output{
        .part = Part::measures, .begin = add_row, .resume = write_table, .window = add_row};
}

} // namespace listric
