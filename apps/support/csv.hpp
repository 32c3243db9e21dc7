#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Rows of the wanted columns of a CSV file.
struct CsvRows {
    std::vector<std::vector<double>> columns; ///< in the order in which they were asked for
    std::vector<std::size_t> line;            ///< of the file, from 1, by row

    std::size_t size() const { return line.size(); }
};

/// Reads numbers from a CSV file with a header; other columns, blank lines and those that begin
/// with # are ignored. Throws SceneError: file, line, column, what is there and what is allowed.
CsvRows read_csv(const std::filesystem::path& file, std::span<const std::string_view> columns,
                 char delimiter = ',');

/// A column of words, a row each as read_csv has them. Throws SceneError.
std::vector<std::string> read_csv_words(const std::filesystem::path& file, std::string_view column,
                                        char delimiter = ',');

/// Whether the header has a column. Throws SceneError if the file cannot be read.
bool csv_has_column(const std::filesystem::path& file, std::string_view name);

} // namespace listric
