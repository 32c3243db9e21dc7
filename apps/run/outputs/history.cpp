#include "apps/archive/summary.hpp"
#include "apps/model/model.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/file.hpp"

#include <algorithm>
#include <limits>

namespace listric {

using namespace measures;

namespace {

/// Nothing: it is not declared. "1": a ratio or a count.
std::string_view unit_of(std::string_view column) {
    if (column == "extension_m")
        return "m";
    if (column == "cycle" || column == "discs")
        return "1";
    const auto measure = std::ranges::find(measure_names(), column, &MeasureName::name);
    return measure == measure_names().end() ? "" : measure->unit;
}

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
        history.add<double>(name, unit_of(name), nan);
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
