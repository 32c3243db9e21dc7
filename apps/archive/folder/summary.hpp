#pragma once

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/archive/tables/observed_misfit.hpp"
#include "apps/measures/faults/fault.hpp"
#include "apps/measures/measures.hpp"
#include "apps/support/named_numbers.hpp"
#include "dem/column.hpp"
#include "dem/state.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace listric::archive {

/// The measures of one moment as named numbers, in the order of history.csv.
NamedNumbers history_row(const dem::State& state, const measures::Measures& measures);

/// Table as CSV; numbers without meaning are left empty.
std::string to_csv(const dem::Table& table);

/// Content of summary.json of a finished run. Referred objects must outlive the call.
struct SummaryContent {
    std::string scene = {}, accuracy = {}; ///< names
    std::uint64_t seed = 0;
    int threads = 1; ///< of each rank
    int ranks = 1;
    std::string cycle = {};  ///< name
    const dem::State& state; ///< at the end
    const RunRecord& record;
    const measures::Measures& measures;
    const measures::FaultReport& faults;
    std::vector<std::string> effects = {};  ///< names of those that were on
    std::vector<std::string> warnings = {}; ///< of the scene
    NamedNumbers numbers = {};              ///< besides the measures
    /// Numbers that belong together, and lists of such objects, by name.
    std::vector<std::pair<std::string, NamedNumbers>> objects = {};
    std::vector<std::pair<std::string, std::vector<NamedNumbers>>> lists = {};
    std::vector<ObservedHorizon> observed = {}; ///< beside the model's
    double wall_seconds = 0.0;
    std::uint64_t state_hash = 0;
    const nlohmann::ordered_json* rocks = nullptr;        ///< rock_record.hpp; none: not recorded
    const nlohmann::ordered_json* provenance = nullptr;   ///< provenance.hpp
    const nlohmann::ordered_json* known_errors = nullptr; ///< known_errors.hpp; none: it has none
};

/// Quantities of every run. One without a function is taken elsewhere.
struct HeadField {
    std::string_view name, unit, label, doc;
    nlohmann::ordered_json (*value)(const SummaryContent& content) = nullptr;
};
std::span<const HeadField> head_fields();

/// summary.json: names and units are part of the program's contract (docs/reference/measures.md).
/// Numbers that are not finite are left out.
std::string summary_json(const SummaryContent& content);

/// Way of the run's clock in a cycle, m, by its summary.json: what a moment may miss a round number
/// by. 0 where the file does not tell.
double cycle_of(const JsonObject& summary);

/// Travel of the wall that a finished run reached, m. None if the file is not a finished run's
/// summary.
std::optional<double> summary_travel(const std::filesystem::path& summary);

} // namespace listric::archive
