#include "apps/archive/tables/observed_misfit.hpp"

#include "apps/run/closing.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

#include <fmt/format.h>

namespace listric {

using namespace archive;

namespace {

std::string line_of(const ObservedHorizon& row) {
    if (!row.misfit)
        return fmt::format("warning: observed {} {}", row.name, row.objection);
    return fmt::format("observed {}: {:.0f} m off in the mean, at most {:.0f} m at x = {:.2f} km; "
                       "{} of {} points beside the top of stratum {}",
                       row.name, row.misfit->mean, row.misfit->largest, row.misfit->worst.x / 1e3,
                       row.misfit->compared, row.points, *row.stratum);
}

/// Compares picked horizons with the model's, and tells.
void compare(RunView& run) {
    compare_picks(run);
    for (const ObservedHorizon& row : run.observed)
        run.log.say(line_of(row));
}

} // namespace

std::optional<Output> outputs::observed(const RunView& run) {
    if (!run.scene.observed)
        return std::nullopt;
    return Output{.part = Part::measures, .finish = compare};
}

} // namespace listric
