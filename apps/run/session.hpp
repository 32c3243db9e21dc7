#pragma once

#include "apps/archive/observed_misfit.hpp"
#include "apps/archive/run_history.hpp"
#include "apps/archive/snapshot.hpp"
#include "apps/measures/fault.hpp"
#include "apps/measures/measures.hpp"
#include "apps/model/base_driver.hpp"
#include "apps/run/options.hpp"
#include "apps/run/run_report.hpp"
#include "apps/scene/effect.hpp"
#include "apps/support/log.hpp"
#include "apps/support/moment_names.hpp"
#include "dem/simulation.hpp"

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// The run of a scene in its folder: a simulation, and what is written of it from window to window.
/// Scene, options and log must outlive it.
class Session {
public:
    Session(const Scene& scene, const RunOptions& options, Log& log);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Goes on from the newest snapshot that can be read. False if there is none.
    bool resume();

    /// Starts from the hanging wall before extension. Throws Interrupted.
    void begin();

    /// Extends to the run's end, window by window. Throws Interrupted after saving.
    void extend();

    /// Writes what is known at the end only: figures, checks, summary.
    void finish();

    double extension() const { return simulation_.extension(); } ///< m

private:
    void make_cycles_by(dem::BaseResponse* response);
    void make_driver();
    void settle_on_base(dem::State& state);
    dem::Execution execution() const;
    double target() const;
    double wall_seconds() const;
    int ranks() const;
    MomentNames names() const;
    void restore_files();
    void keep_scene() const;

    void report_progress(const dem::Simulation& simulation);
    void report_step(const std::string& done, std::optional<SteadyClock::time_point>& asked);
    Observation now() const;
    measures::Measures measure_now() const;
    const measures::FaultReport& faults_now();
    NamedNumbers summary_numbers(const NamedNumbers& of_effects) const;
    std::vector<archive::ObservedHorizon>
    compare_with_observed(const measures::FaultReport& faults);
    void warn_of_haste(const measures::Measures& measures);
    void append_history();
    double next_window_end() const;
    void end_window();
    void save();
    void save_field();
    void draw();
    std::string draw_sheet() const;
    void await_figures();
    void report_window();
    std::vector<fem::StressPatch> stress_below();
    void write_status(const std::string& phase) const;
    void check_base();

    const Scene& scene_;
    const RunOptions& options_;
    Log& log_;
    ModelParts parts_;
    measures::Setting setting_;
    dem::Simulation simulation_;
    std::unique_ptr<BaseDriver> driver_; ///< null: nothing moves the base
    archive::RunRecord record_;
    archive::RunHistory history_; ///< ends of windows that have been saved
    NamedNumbers base_check_;     ///< of the base solved once more
    SteadyClock::time_point started_ = SteadyClock::now();
    double seconds_before_ = 0.0; ///< wall time of the sessions that this one resumes
    std::filesystem::path kept_;  ///< snapshot of the present state, if there is one
    std::vector<std::future<std::string>> figures_; ///< being drawn; each says what is wrong
    RunReport report_;
    std::optional<measures::FaultReport> faults_; ///< of the moment below
    double faults_at_ = -1.0;                     ///< extension, m
    double drawn_at_ = -1.0;                      ///< extension of the last figures, m
    bool has_warned_ = false;                     ///< that the run is too fast
};

} // namespace listric
