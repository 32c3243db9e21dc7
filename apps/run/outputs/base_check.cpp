#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

namespace listric {

namespace {

/// Solves for the base once more on a finer mesh: how far off it is.
void check(RunView& run) {
    if (const std::optional<BaseCheck> found = run.driver->check(run.state())) {
        append(run.numbers, found->measures);
        run.log.say(found->line);
    }
}

} // namespace

std::optional<Output> outputs::base_check(const RunView& run) {
    if (!run.parts.base_moves)
        return std::nullopt;
    return Output{.part = Part::base, .finish = check};
}

} // namespace listric
