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

/// history.csv: a row of measures per window.
class History : public Output {
public:
    Part part() const override { return Part::measures; }

    void resume(RunView& run) override { write(run); }

    void window(RunView& run) override {
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
        write(run);
        if (run.window_of_base.beyond_elasticity)
            throw BeyondElasticity(*run.window_of_base.beyond_elasticity);
    }

private:
    static void write(const RunView& run) {
        write_text(run.options.output / "history.csv", archive::to_csv(run.record.history));
    }
};

} // namespace

std::unique_ptr<Output> outputs::history(const RunView&) { return std::make_unique<History>(); }

} // namespace listric
