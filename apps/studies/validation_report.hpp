#pragma once

#include "apps/studies/validation_plan.hpp"
#include "apps/studies/validation_store.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace listric {

/// Findings of a validation: the content of its document.
struct ValidationFindings {
    const ValidationPlan& plan;
    std::string plan_name;                         ///< its file, for people
    std::vector<ValidationExperiment> experiments; ///< those that were asked for
    const MeasureStore& store;
    std::set<std::string> finished; ///< names of the runs that are there, by run_name()
    std::string accuracy;
    int first_seed = 1;
    int seeds = 1;                ///< of a run at most
    std::filesystem::path beside; ///< folder of the pictures, named as the document

    /// Seeds of a run, finished or not.
    std::vector<int> seeds_of(const ValidationRun& run) const;

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

} // namespace listric
