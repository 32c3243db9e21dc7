#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace listric {

/// One run of the plan at one extension.
struct MeasuredPlace {
    std::string run;
    int seed = 0;
    double at = 0.0; ///< extension, m
    auto operator<=>(const MeasuredPlace&) const = default;
};

/// Origin of measures. An empty text is one that a record of former days does not have.
struct Origin {
    std::string state_hash;    ///< of the run
    std::string scene_hash;    ///< of its parameters
    std::string made_by;       ///< Listric that made the run: version and commit
    std::string measured_by;   ///< Listric that measured it
    std::string measures_hash; ///< of the definitions of measures (apps/support/version.hpp)
    bool operator==(const Origin&) const = default;
};

/// Measures of one moment.
struct MeasuredNumbers {
    Origin from;
    std::map<std::string, double> numbers;
};

using MeasureStore = std::map<MeasuredPlace, MeasuredNumbers>;

/// A measure; none where it has no meaning or was not measured.
std::optional<double> number_at(const MeasureStore& store, const MeasuredPlace& place,
                                const std::string& measure);

/// Reads measures.csv; an absent file is an empty store. Throws StorageError if it is damaged.
MeasureStore read_store(const std::filesystem::path& file);

/// Throws StorageError.
void write_store(const std::filesystem::path& file, const MeasureStore& store);

} // namespace listric
