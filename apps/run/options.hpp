#pragma once

#include "apps/archive/folder/output_folder.hpp"
#include "apps/support/machine/stop.hpp"
#include "dem/cycle/cycle.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace listric::dem {
class RankedCycles;
}

namespace listric {

/// What a run keeps that is one of many.
enum class Lean {
    no,   ///< all that it writes
    last, ///< scene, history, log, summary and the last snapshot
    all   ///< the same with all snapshots
};

/// How a scene is run.
struct RunOptions {
    std::filesystem::path output;
    std::optional<double> until;           ///< extension at which the run ends, m
    int threads = 1;                       ///< of each rank
    dem::RankedCycles* on_ranks = nullptr; ///< makes their cycles; none: there is one process
    bool plain = false; ///< the scalar cycle instead of the fast one, for comparison
    bool resume = false;
    bool force = false;
    bool quiet = false;
    bool figures = true; ///< drawn at the scene's extensions and at the end
    bool report = true;  ///< report.html is written at the end
    bool live = false;   ///< and after every window
    Lean lean = Lean::no;
    bool warned = false; ///< the caller has told what the scene warns of
    StopToken stop;      ///< where it is requested, the run saves and stops as soon as it can

    archive::ExistingRun existing() const {
        using enum archive::ExistingRun;
        return force ? replaced : resume ? resumed : refused;
    }

    dem::Execution execution() const {
        return {threads, plain ? dem::Cycle::plain : dem::best_cycle()};
    }

    /// Extension at which the run ends of a scene that goes so far, m.
    double end(double distance) const { return std::min(distance, until.value_or(distance)); }
};

enum class RunOutcome { finished, interrupted };

} // namespace listric
