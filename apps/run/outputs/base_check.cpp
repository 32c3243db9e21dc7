#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

#include <fmt/format.h>

namespace listric {

namespace {

/// Solves for the base once more on a finer mesh: how far off it is.
void check(RunView& run) {
    const auto fine = run.footwall ? run.footwall->check(run.state()) : std::nullopt;
    if (!fine)
        return;
    append(run.numbers, {{"base_elements_difference", fine->elements},
                         {"base_resolved_difference", fine->base}});
    run.log.say(fmt::format("the base under the last window's mean forces, solved again with "
                            "{} unknowns: the run's elements are {:.2f} % off, its base "
                            "{:.2f} %",
                            fine->unknowns, 100.0 * fine->elements, 100.0 * fine->base));
}

} // namespace

std::optional<Output> outputs::base_check(const RunView& run) {
    if (!has_effect(run.scene, "elastic_base"))
        return std::nullopt;
    return Output{.part = Part::base, .finish = check};
}

} // namespace listric
