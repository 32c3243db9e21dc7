#pragma once

#include "apps/archive/folder/json_file.hpp"
#include "dem/clocks.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric::archive {

// Bounds of a good run (docs/explain/trust.md).
inline constexpr double most_mass_error = 1e-12, most_volume_error = 1e-3;
inline constexpr double least_area_balance = 0.95, most_area_balance = 1.03;
inline constexpr dem::Extension area_balance_from{5e3};
inline constexpr double fewest_discs_across = 5; ///< of what is interpreted

enum class QualityVerdict {
    good,
    doubtful,
    note ///< has no bound in this run, or tells what may be interpreted
};

/// One question of "Is this run good?", with its answer.
struct QualityCheck {
    std::string key;   ///< in summary.json
    std::string label; ///< a noun: "balance of areas"
    std::string value; ///< for people: "0.976", "yes"
    std::string bound; ///< for people: "0.95 to 1.03"
    QualityVerdict verdict = QualityVerdict::note;
    std::string words = {}; ///< a sentence on the meaning, and on the cure where it is doubtful
    std::string brief = {}; ///< among the results of a run: "mass error 2e-15"; none: left out
};

/// Facts of a run that its summary does not hold.
struct QualityContext {
    bool base_moves = false;
    double mean_radius = 0.0;                 ///< m
    std::optional<double> base_friction = {}; ///< of detachment or stretching base
};

/// Questions that a finished run's summary.json answers, in the order of docs/explain/trust.md;
/// none of an empty object.
std::vector<QualityCheck> quality_checks(const JsonObject& summary, const QualityContext& context);

/// "good", "doubtful" or "note".
const char* name_of(QualityVerdict verdict);

/// Verdict on a run by all of its questions: doubtful if one is; a note where nothing is judged.
QualityVerdict verdict_of(const std::vector<QualityCheck>& checks);

/// "good: quasi-static, mass error 2e-15", and below it why it is doubtful, if it is.
std::vector<std::string> verdict_lines(const std::vector<QualityCheck>& checks);

} // namespace listric::archive
