#pragma once

#include "apps/archive/folder/run_history.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/archive/tables/observed_misfit.hpp"
#include "apps/measures/faults/fault.hpp"
#include "apps/measures/measures.hpp"
#include "apps/model/base_driver.hpp"
#include "apps/run/forecast/time_left.hpp"
#include "apps/run/options.hpp"
#include "apps/run/part.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/picks/rock_line.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/moment_names.hpp"
#include "dem/simulation.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace listric {

enum class Phase { genesis, extension, stopped, finished, failed };

/// A run as its outputs see it: what it is, where it has come to, and what several of them need,
/// made once. Scene, options, log and simulation must outlive it.
class RunView {
public:
    RunView(const Scene& scene, const RunOptions& options, Log& log,
            const dem::Simulation& simulation);

    const Scene& scene;
    const RunOptions& options;
    Log& log;
    const dem::Simulation& simulation;
    const ModelParts parts;
    const measures::Setting setting;
    std::unique_ptr<BaseDriver> driver; ///< null: nothing moves the base, or not yet

    Phase phase = Phase::genesis;
    archive::RunRecord record;
    archive::RunHistory past;                       ///< ends of windows before the present one
    BaseWindow window_of_base;                      ///< that has ended last
    std::filesystem::path kept;                     ///< snapshot that was written last
    NamedNumbers numbers;                           ///< of outputs, for summary.json
    std::vector<archive::ObservedHorizon> observed; ///< misfits of picked horizons
    std::string summary;                            ///< summary.json, once the run is closed
    std::optional<RockOrigins> rocks;               ///< as the run was begun; none: not recorded

    const dem::State& state() const { return simulation.state(); }
    dem::Travel travel() const { return simulation.travel(); }
    dem::Extension extension() const { return simulation.extension(); }
    dem::Travel target() const { return dem::Travel(options.end(scene.extension.distance)); }
    Observation now() const { return {scene, parts, state(), simulation.events()}; }

    bool has_stages() const { return !simulation.base().motion.stages.empty(); }

    /// "5 km of extension"; with stages of motion "1 km of net extension after 9 km of wall
    /// motion".
    /// @param interval  extensions that texts tell apart, m; none: length_text()'s own
    std::string place_text(std::optional<double> interval = {}) const;

    int ranks() const;

    /// The footwall with the field of the present moment, until that of another one is recovered;
    /// null: nothing is known below the base.
    const fem::Footwall* footwall() const { return driver ? driver->recover(state()) : nullptr; }

    /// By the windows that have ended.
    MomentNames names() const;
    bool is_window_end() const { return names().is_window_end(travel().m); }
    dem::Travel next_window_end() const;
    bool is_drawn() const; ///< whether the scene wants pictures of the present moment

    /// Path of the present moment's snapshot, whether that file exists or not.
    std::filesystem::path snapshot() const;

    /// Snapshots at the ends of windows up to the present moment, oldest first.
    std::vector<std::filesystem::path> ended_windows() const;

    const measures::Measures& measured();
    const measures::FaultReport& faults();                        ///< followed back to their birth
    bool knows_faults() const { return faults_.is_of(travel()); } ///< of the present moment

    /// The measures of the present moment, a row of history.csv. NaN: no meaning in this run.
    NamedNumbers row();
    void add_row(); ///< to the record's history

    /// Throws BeyondElasticity if the base is, by the window that has ended last.
    void require_elasticity() const;

    double wall_seconds() const { return seconds_before_ + seconds_since(started_); }
    double seconds_left() const { return time_left_.at(seconds_since(started_)); }

    /// Begins to count time: what the session is expected to take.
    void expect(const Forecast& forecast) {
        time_left_ = TimeLeft(forecast);
        record.predicted_seconds = forecast.all(); // of the first session, once it is known
    }
    void count_cycles(); ///< takes a reading of what has been done
    void end_cycles() { time_left_.end_extension(seconds_since(started_)); }

    /// Shows people how far the run is, and what it does; nothing said: the extension.
    void show_progress(const std::string& what = {});

    /// Writes down the scene, and the names of its rocks.
    void begin_record();

    /// Takes over the record of the sessions that this one resumes; their wall time counts, too.
    void go_on_with(const std::filesystem::path& snapshot, archive::RunRecord earlier);

    PartWatch watch(Part part) { return {record.seconds_by_part, part}; }

private:
    /// Measures and faults of a moment, as far as they have been made.
    template <class T> struct Made {
        std::optional<T> value;
        dem::Travel at;
        bool is_of(dem::Travel moment) const { return value && at == moment; }
    };
    template <class T, class Make> const T& made_once(Made<T>& made, Make&& make);

    TimeLeft time_left_;
    double seconds_before_ = 0.0;
    SteadyClock::time_point started_ = SteadyClock::now();
    Made<measures::Measures> measures_;
    Made<measures::FaultReport> faults_;
};

} // namespace listric
