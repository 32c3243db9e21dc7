#pragma once

#include "apps/archive/folder/run_records.hpp"
#include "apps/run/batch.hpp"
#include "apps/scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace listric {

/// A call of `listric study`: what accuracy costs in time. It makes one run at a time.
struct StudyRequest : ManyRuns {
    std::string name = {};             ///< see studies()
    std::string scene = {};            ///< of studies made of runs; empty: the study's own
    std::vector<std::string> set = {}; ///< "table.key=value", for every run
    std::vector<double> values = {};   ///< of the swept parameter; empty: the study's own
    std::int64_t seed = 1;             ///< of the first run
    int seeds = 3;
};

/// Error and cost of one way to compute one quantity.
struct StudyPoint {
    std::string method;      ///< "panel: curve", or "curve"; without commas
    std::string parameter;   ///< "name=value" of what is varied along the curve
    std::string quantity;    ///< whose error
    double error = 0.0;      ///< dimensionless; infinite: it failed
    double wall = 0.0;       ///< s
    double disc_steps = 0.0; ///< 0 without discs
};

struct StudyResult {
    std::string title;
    std::vector<StudyPoint> points;
    /// By quantity: spread between seeds, below which refinement buys nothing.
    std::map<std::string, double> floors;
    std::vector<archive::RecordedRun> runs = {}; ///< of shipped scenes, for apps/records
};

struct Study {
    std::string_view name, doc;
    StudyResult (*make)(const StudyRequest& request);
    bool has_values = false; ///< a call may choose those of the parameter that is varied
    bool has_scene = true;   ///< it is made of runs, of a scene that a call may choose and change
    int most_seeds = 1000;
};

std::span<const Study> studies();

/// Makes a study; leaves study.csv, study.json, study.png and, of runs of a shipped scene, runs.csv
/// in the output folder, and prints a table. Runs that are there already are not made again. Throws
/// UsageError, SceneError, StorageError, Interrupted: the same call goes on from there.
void run_study(StudyRequest request);

// Studies made of runs.
StudyResult study_resolution(const StudyRequest& request);
StudyResult study_speed(const StudyRequest& request);

/// Softer discs, at the level's speed and at 2 and 3 m/s: what they save and what they change.
StudyResult study_softness(const StudyRequest& request);

// Studies of the cycle.
StudyResult study_time_step(const StudyRequest& request);
StudyResult study_precision(const StudyRequest& request);

// Studies of the elastic base.
StudyResult study_footwall(const StudyRequest& request);
StudyResult study_coupling(const StudyRequest& request);

/// Uplift and deflection against the effective elastic thickness, beside the thin plate under the
/// same net load; leaves isostasy.csv and isostasy.png, too.
StudyResult study_isostasy(const StudyRequest& request);

/// The call with its own scene, or else this one.
StudyRequest with_scene(StudyRequest request, const char* scene);

/// The scene of a call, with its changes.
Scene scene_of(const StudyRequest& request);

/// A run of a scene with changes, by one seed.
struct StudyRun {
    std::string parameter;        ///< "name=value"; names the run's folder
    std::vector<std::string> set; ///< changes of the scene
    std::optional<std::string> accuracy = {};
    std::vector<std::string> without = {}; ///< effects that are off
    int most_seeds = 1000;                 ///< of a run that is too dear to be repeated
};

/// A run for each value of a parameter, "table.key", that points name "name=value".
std::vector<StudyRun> runs_along(std::string_view name, std::string_view parameter,
                                 const std::vector<double>& values,
                                 const std::vector<std::string>& set = {},
                                 const std::optional<std::string>& accuracy = "draft");

/// Where the run by one seed is.
std::filesystem::path folder_of_run(const StudyRequest& request, const StudyRun& run,
                                    std::int64_t seed);

struct SeededRun {
    StudyRun run;
    std::int64_t seed;
};

/// The summaries of runs, which are made unless they are there; none where the numerics failed.
std::vector<std::optional<nlohmann::ordered_json>>
summaries_of_runs(const StudyRequest& request, std::span<const SeededRun> wanted);

/// Quantity in which errors are measured.
struct StudyQuantity {
    std::string name;
    double scale = 0.0;    ///< of the error, in the quantity's unit; 0: relative to the reference
    bool is_error = false; ///< an error itself: no reference is needed
};

/// Makes runs for every seed and measures them against the mean of the last one's over its seeds:
/// an error is the root mean square over seeds. Adds points of `method` and, from this reference,
/// floors.
void sweep_runs(const StudyRequest& request, const std::string& method,
                const std::vector<StudyRun>& runs, const std::vector<StudyQuantity>& quantities,
                StudyResult& result);

} // namespace listric
