#pragma once

#include "apps/archive/run_history.hpp"
#include "apps/figures/report_moments.hpp"
#include "apps/scene/effect.hpp"
#include "apps/support/log.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace listric {

/// What a report keeps in memory of a run's moments, bytes. Of more it is made anew at the end,
/// from the snapshots.
inline constexpr double most_of_report = 2e8;

/// report.html of a run that is going on: a window adds to it. What goes wrong with it is a
/// warning, and the end of the report, not of the run. Scene and log must outlive it.
class RunReport {
public:
    /// @param output  the run's folder
    /// @param live    the file is there from the first window on
    RunReport(const Scene& scene, std::filesystem::path output, bool wanted, bool live, Log& log)
        : scene_(scene), output_(std::move(output)), log_(log), wanted_(wanted), live_(live) {}

    /// Whether there is to be one, and nothing has gone wrong with it.
    bool is_wanted() const { return wanted_; }

    /// Whether it has a moment, with faults that have been followed back if that is asked.
    bool has(double extension, bool followed) const {
        return overflows_ || moments_.has(extension, followed);
    }

    /// The moments of a run that goes on, at the ends of its windows.
    void read_moments(const std::vector<std::filesystem::path>& window_ends,
                      const archive::RunHistory& history);

    /// Adds a moment, or other lines to the last one.
    /// @param history  up to that moment
    void add(const Observation& now, const archive::RunHistory& history);

    /// The same with faults that have been followed back, and the stress below an elastic base.
    void add(const Observation& now, const measures::FaultReport& faults,
             const std::vector<fem::StressPatch>& footwall);

    /// Writes the file if the run goes on and the report is live.
    /// @param history  as history.csv
    void write_live(const std::string& history);

    /// @param summary  as summary.json
    void write(const std::string& history, const std::string& summary);

private:
    void attempt(const std::function<void()>& work);
    void keep(const Observation& now, SectionLines lines);
    void limit();
    void write_page(const std::string& history, const std::string& summary, bool live);

    const Scene& scene_;
    std::filesystem::path output_;
    Log& log_;
    bool wanted_, live_;
    bool overflows_ = false; ///< moments are no longer kept
    double mean_radius_ = 0.0;
    ReportMoments moments_;
    LinesOfMoments lines_;
};

} // namespace listric
