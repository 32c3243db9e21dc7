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

/// Measures of one moment, the hash of the run that they come from, and which Listric made the run
/// and which measured it: version and commit.
struct MeasuredNumbers {
    std::string hash, made_by, measured_by;
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
