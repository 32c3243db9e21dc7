#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/measures/evolution.hpp"
#include "apps/run/closing.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/support/error.hpp"

#include <exception>
#include <string>
#include <utility>

namespace listric {

namespace {

/// The hanging wall before extension; none where its snapshot is gone or cannot be read.
std::optional<dem::State> start_of(const RunView& run) {
    const auto snapshots = archive::list_snapshots(run.options.output);
    if (snapshots.empty())
        return std::nullopt;
    try {
        dem::State first = archive::read_snapshot(snapshots.front()).state;
        return first.clock.cycle == 0 ? std::optional(std::move(first)) : std::nullopt;
    } catch (const std::exception& error) {
        run.log.say(std::string("warning: no dilation of rock: ") + words_of(error));
        return std::nullopt;
    }
}

void measure(RunView& run) {
    if (const std::optional<dem::State> start = start_of(run))
        add_dilation(run, measures::remember(run.setting, run.parts.base, *start, {}));
}

} // namespace

std::optional<Output> outputs::dilation(const RunView&) {
    return Output{.part = Part::measures, .finish = measure};
}

} // namespace listric
