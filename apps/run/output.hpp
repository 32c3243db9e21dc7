#pragma once

#include "apps/run/part.hpp"

#include <memory>
#include <span>

namespace listric {

class RunView;

/// One of the things that a run leaves in its folder, or says of itself: told of the run's moments,
/// in which it writes what it wants to. It reads the run and changes nothing of it.
class Output {
public:
    Output() = default;
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    virtual ~Output() = default;

    /// Whose wall time it takes.
    virtual Part part() const { return Part::output; }

    /// The run enters another phase, RunView::phase.
    virtual void enter(RunView&) {}

    /// The hanging wall before extension is there: the end of window 0.
    virtual void begin(RunView& run) { window(run); }

    /// The run goes on from a snapshot. The session before may have been killed anywhere: puts in
    /// place what the folder must have.
    virtual void resume(RunView&) {}

    /// A window of extension has ended.
    virtual void window(RunView&) {}

    /// The run stops or ends within a window.
    virtual void save(RunView&) {}

    /// The run has come to its end, and all is saved. A stop request ends it before close().
    virtual void finish(RunView&) {}

    /// All outputs have finished: writes what says so.
    virtual void close(RunView&) {}
};

/// Makes an output; none where the run does not call for it.
using MakeOutput = std::unique_ptr<Output> (*)(const RunView& run);

/// A run's outputs, in the order in which they are told.
using OutputList = std::span<const MakeOutput>;

} // namespace listric
