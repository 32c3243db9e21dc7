#pragma once

#include "apps/run/output.hpp"
#include "apps/run/run_view.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric {

/// The run of a scene in its folder: a simulation, which it builds or resumes, advances and stops,
/// and outputs, which it tells so. Scene, options and log must outlive it.
class Session {
public:
    Session(const Scene& scene, const RunOptions& options, Log& log, OutputList outputs);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// From the hanging wall before extension, or from the newest snapshot that can be read if it
    /// is to be resumed, to the end.
    RunOutcome run();

private:
    using Hook = Output::Work Output::*;
    void tell(Hook hook);
    void enter(Phase phase);

    bool resume();
    void begin();
    void extend();
    void finish();
    void end_window(Hook hook);
    void keep();
    void report_step(const std::string& done);

    RunView run_;
    dem::Simulation simulation_;
    std::vector<Output> outputs_;
    std::optional<SteadyClock::time_point> stop_seen_; ///< within an event
};

} // namespace listric
