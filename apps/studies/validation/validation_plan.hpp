#pragma once

#include "apps/scene/toml/shelf.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Where the program's plans are.
inline constexpr Shelf validation_plans{"validation plan", "it needs [[run]] and [[experiment]]",
                                        "", "studies"};

/// A run that the validation needs, in one folder per seed.
struct ValidationRun {
    std::string name;             ///< folder: NAME-SEED
    std::string scene;            ///< that it runs
    std::vector<std::string> set; ///< table.key=value
    std::vector<std::string> without;
    int seeds = 0;          ///< that it is run with; 0: as many as asked for
    std::string accuracy;   ///< empty: the one asked for
    std::vector<double> at; ///< extensions at which it is measured, m
};

/// Expectation of a measure, with its source.
struct Expectation {
    enum class Kind { faults, kinematics, conservation } kind = Kind::faults;
    std::string measure;               ///< name in docs/reference/measures.md
    std::string over;                  ///< the measure by which it is divided
    std::string what;                  ///< for people
    std::string run;                   ///< empty: the experiment's first
    std::string minus;                 ///< the run whose value is taken off, seed by seed
    std::optional<double> at;          ///< extension, m; default: the run's last
    std::optional<double> since;       ///< extension whose value is taken off, m
    std::optional<double> mean_from;   ///< extension, m: mean over the run's moments since then
    bool of_mean = false;              ///< the seeds' mean is judged, not each
    double unit = 1.0;                 ///< value / unit is what is shown and judged
    int digits = 2;                    ///< shown after the point
    std::optional<double> expected;    ///< within the tolerance,
    double tolerance = 0.0;            ///<
    std::optional<double> least, most; ///< or between these; none of all: reported
    std::string words;                 ///< of the published text that say so
    std::string source;                ///< figure and moment of the words, or the formula
    std::string reason;                ///< why it is only reported
    bool is_shared = false;            ///< of an experiment that its own is like

    bool is_judged() const { return expected || least || most; }
    bool meets(double value) const;
    std::string target() const; ///< "38.20 ± 0.50", "at least 0.60"

    /// Moments of a run whose mean the value is: the last, or those since mean_from.
    std::vector<double> moments_of(const ValidationRun& of, double last) const;
};

std::string_view name_of(Expectation::Kind kind);

/// A picture of states below each other.
struct ValidationPicture {
    struct Row {
        std::string run;
        double at = 0.0; ///< extension, m
        int seeds = 0;   ///< 0: all
    };
    std::string name, caption;
    std::vector<Row> rows;
};

/// A row that was asked for once and is no more.
struct DroppedRow {
    std::string what, asked, reason;
};

struct ValidationExperiment {
    std::string name, title;
    std::string about;        ///< before the table
    std::string seen;         ///< people's reading of the pictures of the standard runs
    std::vector<int> seen_of; ///< seeds that this reading is about
    std::vector<std::string> runs;
    std::string like;    ///< an experiment whose expectations it has, of its own runs
    std::string compare; ///< a run whose values stand beside the first's
    std::vector<Expectation> expectations; ///< faults, kinematics, conservation, in that order
    std::vector<DroppedRow> dropped;
    std::vector<ValidationPicture> pictures;
};

struct ValidationPlan {
    std::vector<int> seeds; ///< of the record; empty: it has no seeds of its own
    std::vector<ValidationRun> runs;
    std::vector<ValidationExperiment> experiments;

    const ValidationRun& run(const std::string& name) const; ///< must be there
};

/// Reads runs, experiments and expectations from a TOML file. One that `extends` another, a name on
/// the shelf or a path beside it, may have experiments that are like those. Throws SceneError.
ValidationPlan load_validation_plan(const std::filesystem::path& file);

/// JSON schema of a plan's file.
std::string validation_schema();

/// Verdict of the seeds on an expectation.
///
/// A row of faults asks how often a packing does that: *shown* is more often than not, *not shown*
/// less often than not, each at a confidence of 95 % (the limits of probability_limits() above or
/// below one half), *open* neither. Kinematics and conservation have to hold in every seed.
struct Verdict {
    enum class Name { no_run, reported, no_case, shown, open, not_shown, met, missed };
    Name name = Name::no_run;
    int met = 0, of = 0; ///< seeds that have a value
    int no_case = 0;     ///< seeds that have none
    std::string text;    ///< "shown (18 of 20: 0.72 to 0.98)", "missed (4 of 5)", "reported"
};

/// "not shown"
std::string_view name_of(Verdict::Name name);

/// @param values  one per seed; none: the measure has no meaning there, so it is no case
Verdict judge(const Expectation& expectation, std::span<const std::optional<double>> values);

} // namespace listric
