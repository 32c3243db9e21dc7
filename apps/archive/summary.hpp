#pragma once

#include "apps/archive/snapshot.hpp"
#include "apps/measures/fault.hpp"
#include "apps/measures/measures.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/named_numbers.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace listric {

/// The measures of one moment as named numbers, in the order of history.csv.
NamedNumbers history_row(const dem::State& state, const measures::Measures& measures);

/// Table as CSV; numbers without meaning are left empty.
std::string to_csv(const dem::Table& table);

/// summary.json: names and units are part of the program's contract (docs/measures.md).
std::string summary_json(const Scene& scene, int threads, const dem::State& state,
                         const RunRecord& record, const measures::Measures& measures,
                         const measures::FaultReport& faults, double wall_seconds,
                         std::uint64_t state_hash);

/// Extension that a finished run reached, m. None if the file is not a finished run's summary.
std::optional<double> summary_extension(const std::filesystem::path& summary);

} // namespace listric
