#pragma once

#include "apps/archive/folder/run_records.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/measure.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

/// One part of a measure's error, in the measure's unit.
struct ErrorPart {
    double value = 0.0;
    int runs = 0;             ///< that were recorded at the level itself
    double mean_radius = 0.0; ///< at which it was recorded, m
    std::string record;       ///< where it comes from
    std::string against;      ///< "mean radius 18.62 m": what the runs are compared with
};

/// Errors of a measure at one resolution, speed and softness by recorded runs; none: unknown.
struct KnownError {
    std::string key;                     ///< of the measure in summary.json
    std::optional<ErrorPart> resolution; ///< mean less that of the finest runs
    /// Mean less that of the runs that are pulled slowest, of the stiffest discs; at the level's
    /// resolution or, where that has none, at the nearest coarser one, and at its speed and
    /// softness or the nearest greater ones.
    std::optional<ErrorPart> speed;
    std::optional<ErrorPart> spread; ///< standard deviation between seeds
    double mean = 0.0;               ///< of the level's runs; 0: there is none
};

/// The pace of a scene's runs.
Pace pace_of(const Scene& scene);

/// Whether they are the same, to a thousandth.
bool are_near(const Pace& one, const Pace& other);

/// Runs that a question on errors is about.
struct ErrorQuestion {
    std::string scene;        ///< name of a shipped scene
    double mean_radius = 0.0; ///< m
    Pace pace;
    double extension = 0.0; ///< m
};

/// Errors of the headline measures, in their order.
std::vector<KnownError> known_errors(std::span<const RecordedRun> runs,
                                     const ErrorQuestion& question);

/// The parameter in which a scene differs from the shipped one of its name, besides seed, level,
/// resolution, speed, softness, extension and pictures: its errors are not those of the record.
/// Empty: in none. A scene without a shipped one of its name differs in its name.
std::string departs_from_record(const Scene& scene);

/// The question that a scene puts.
ErrorQuestion error_question(const Scene& scene);

/// Errors of a run of a scene for summary.json: a list of objects (`error_fields`), in which
/// "unknown" stands for what no record tells. Never throws: a damaged record is one that is not
/// there.
/// @param extension  that the run has reached, m
nlohmann::ordered_json known_errors_json(const Scene& scene, double extension);

/// The list in summary.json, and the fields of its objects.
extern const Quantity known_errors_quantity;
std::span<const Quantity> error_fields();

/// A number of a measure with its unit and a sensible number of digits: "0.12 km", "0.03°".
std::string error_text(const std::string& key, double value);

} // namespace listric::archive
