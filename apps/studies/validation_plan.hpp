#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

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
    enum class Kind { kinematics, faults, conservation } kind = Kind::faults;
    enum class Needed { each, most, mean } needed = Needed::each; ///< of the seeds
    enum class Absent { missed, met } absent = Absent::missed;    ///< where there is no value
    std::string measure;                                          ///< name in docs/measures.md
    std::string what;                                             ///< for people
    std::string run;                                              ///< empty: the experiment's first
    std::string minus;                 ///< the run whose value is taken off, seed by seed
    std::optional<double> at;          ///< extension, m; default: the run's last
    std::optional<double> since;       ///< extension whose value is taken off, m
    double unit = 1.0;                 ///< value / unit is what is shown and judged
    int digits = 2;                    ///< shown after the point
    std::optional<double> expected;    ///< within the tolerance,
    double tolerance = 0.0;            ///<
    std::optional<double> least, most; ///< or between these; none of all: reported
    std::string source;

    bool is_judged() const { return expected || least || most; }
    bool meets(double value) const;
    std::string target() const; ///< "38.20 ± 0.50", "at least 0.60"
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

struct ValidationExperiment {
    std::string name, title;
    std::string about; ///< before the table
    std::string seen;  ///< people's reading of the pictures of the standard runs
    std::vector<std::string> runs;
    std::string like;    ///< an experiment whose expectations it has, of its own runs
    std::string compare; ///< a run whose values stand beside the first's
    std::vector<Expectation> expectations;
    std::vector<ValidationPicture> pictures;
};

struct ValidationPlan {
    std::vector<ValidationRun> runs;
    std::vector<ValidationExperiment> experiments;

    const ValidationRun& run(const std::string& name) const; ///< must be there
};

/// Reads runs, experiments and expectations from a TOML file. One that `extends` another, a name on
/// the shelf or a path beside it, may have experiments that are like those. Throws SceneError.
ValidationPlan load_validation_plan(const std::filesystem::path& file);

/// Verdict of the seeds on an expectation.
struct Verdict {
    int met = 0, of = 0;
    bool fulfilled = false; ///< as far as the expectation needs
    std::string text;       ///< "met", "in 3 of 5 seeds", "missed", "reported", "no run yet"
};

/// @param values  one per seed; none: the measure has no meaning there
Verdict judge(const Expectation& expectation, std::span<const std::optional<double>> values);

} // namespace listric
