#pragma once

#include "apps/run/part.hpp"

#include <functional>
#include <optional>
#include <span>

namespace listric {

class RunView;

/// One of the things that a run leaves in its folder, or says of itself: what it does at the run's
/// moments. It never changes the simulation. What is null does not concern it.
struct Output {
    using Work = std::function<void(RunView& run)>;

    Part part = Part::output; ///< whose wall time it takes
    Work enter = {};          ///< the run enters another phase, RunView::phase
    Work begin = {};          ///< the hanging wall before extension is there, the end of window 0
    /// The run goes on from a snapshot. The session before may have been killed anywhere: puts in
    /// place what the folder must have.
    Work resume = {};
    Work window = {}; ///< a window of extension has ended
    Work save = {};   ///< the run stops or ends within a window
    Work finish = {}; ///< the run is at its end, and saved; a stop request ends it before close
    Work close = {};  ///< all outputs have finished: writes what says so
};

/// Makes an output; none where the run does not call for it.
using MakeOutput = std::optional<Output> (*)(const RunView& run);

/// A run's outputs, in the order in which they are told.
using OutputList = std::span<const MakeOutput>;

} // namespace listric
