#pragma once

#include "apps/studies/validation/validation_plan.hpp"
#include "apps/studies/validation/validation_store.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace listric {

/// Findings of a validation: the content of its document.
struct ValidationFindings {
    const ValidationPlan& plan;
    std::string plan_name;                              ///< its file, for people
    std::vector<ValidationExperiment> experiments = {}; ///< that are recorded, by their first run
    std::vector<std::string> missing = {};              ///< names of those that are not
    const MeasureStore& store;
    std::string accuracy;
    std::vector<int> seeds;       ///< that the document is about
    std::filesystem::path beside; ///< folder of the pictures, named as the document
    std::set<std::string> with_other_parameters = {}; ///< names of recorded runs, than the plan's
    std::set<std::string> uncompared = {}; ///< of another version, which may write them otherwise
    std::map<std::string, std::string> failed = {}; ///< reasons of runs that this call made

    /// Seeds of a run, recorded or not: as many of the document's as the run is made with.
    std::vector<int> seeds_of(const ValidationRun& run) const;

    /// Whether a run is recorded at all of its moments.
    bool is_recorded(const ValidationRun& run, int seed) const;

    /// Whether an expectation's measure is recorded of any run: where not, its absence means
    /// nothing.
    bool is_measured(const Expectation& e) const;

    /// Verdict on an expectation: on its run, or on another in that one's place.
    Verdict verdict(const Expectation& e) const;

    /// The value of each seed that has run; an empty one where the measure has no meaning.
    /// @param of  name of the run
    std::vector<std::optional<double>> values(const Expectation& e, const std::string& of) const;
};

/// Name of a run by one seed, and of its folder.
std::string run_name(const std::string& run, int seed);

/// "10 km"
std::string extension_text(double at);

/// The document, Markdown.
std::string validation_document(const ValidationFindings& findings);

/// Content of its chart, as JSON: of every experiment with several seeds that is not beside one
/// that it is like, the rows of faults with a letter per seed (m met, x missed, o no case, - no
/// run), and the verdicts.
std::string validation_chart(const ValidationFindings& findings);

} // namespace listric
