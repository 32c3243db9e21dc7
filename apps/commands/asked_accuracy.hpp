#pragma once

#include "apps/archive/folder/known_errors.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/scene/scene_file.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// Wishes of a call in place of a level of accuracy.
struct AskedAccuracy {
    std::string within; ///< a time: 10min; empty: not asked
    std::string error;  ///< tilt=0.1deg,cutoff=0.2km or 2%; empty: not asked

    bool is_asked() const { return !within.empty() || !error.empty(); }
};

/// --within and --error.
void add_asked_accuracy(CLI::App& command, AskedAccuracy& asked);

/// "90s", "10min", "2h" or "1.5d" in seconds. Throws UsageError.
double parse_duration(const std::string& option, const std::string& text);

/// A bound of a measure's error: in the measure's unit, or a share of its mean.
struct ErrorTarget {
    std::string key;
    double most = 0.0;
    bool is_share = false;
};

/// Targets of "tilt=0.1deg,cutoff=0.2km": words of measures with a number and a unit, or with a
/// percentage of the measure's mean. A percentage alone asks it of tilt, cutoff and area balance.
/// Throws UsageError.
std::vector<ErrorTarget> parse_error_targets(const std::string& text);

/// A way to make a scene's runs that has been recorded.
struct AccuracyChoice {
    std::string level;
    archive::Pace pace;
    int seeds = 1;
    double seconds = 0.0; ///< predicted, of all seeds
    std::vector<archive::KnownError> errors = {};
};

/// Error that the mean over a choice's seeds stays below with a probability of 90 %: distances from
/// the finest and from the slowest recorded runs, and Student's quantile of the spread between the
/// recorded seeds times the root of 1/seeds + 1/recorded. None where one of them is unknown.
std::optional<double> promised_error(const archive::KnownError& error, int seeds);

/// Recorded ways to run a scene, one seed each, from the quickest on. Those without any known error
/// are left out.
/// @param seconds  predicted time of a scene's run
std::vector<AccuracyChoice> recorded_choices(std::span<const archive::RecordedRun> runs,
                                             const SceneRequest& request,
                                             const std::function<double(const Scene&)>& seconds);

/// The choice of least time that meets all targets; none.
std::optional<AccuracyChoice> cheapest_choice(std::span<const AccuracyChoice> choices,
                                              std::span<const ErrorTarget> targets);

/// The finest level that fits into the time, at its slowest recorded speed of which an error is
/// promised, if there is one, with as many seeds as fit (at most ten); none.
std::optional<AccuracyChoice> best_choice(std::span<const AccuracyChoice> choices, double seconds);

/// The answer of `explain` in text.
std::string explain_asked(const AskedAccuracy& asked, const SceneRequest& request, int threads);

/// Puts level and speed that are asked for into a run's scene, and says so in a line with what else
/// is to be run. Throws UsageError where nothing recorded supports an answer.
std::string apply_asked(const AskedAccuracy& asked, SceneRequest& request, int threads);

} // namespace listric
