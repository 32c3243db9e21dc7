#include "apps/run/closing.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/files/file.hpp"

namespace listric {

namespace {

/// Writes summary.json of the finished run.
void write_summary(RunView& run) {
    run.summary = summary_of(run);
    write_text(run.options.output / "summary.json", run.summary);
}

} // namespace

std::optional<Output> outputs::summary(const RunView&) { return Output{.close = write_summary}; }

} // namespace listric
