#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Columns to read from a CSV file; it may have others.
struct CsvColumns {
    std::string_view words = {};                 ///< a column of words; none: no words are wanted
    std::vector<std::string_view> numbers = {};  ///< columns with a number in every row
    std::vector<std::string_view> optional = {}; ///< columns that may be missing, or empty in a row
    std::vector<std::string_view> labels = {};   ///< columns of words that may be missing, in
                                                 ///< capitals or not
    std::string_view delimiter = "auto";         ///< "auto": that with which the header has them
};

/// Words of csv_delimiter: "auto", ",", ";", "tab", "blank".
std::vector<std::string_view> csv_delimiters();

/// Rows of the wanted columns of a CSV file.
struct CsvRows {
    std::vector<std::string> words;
    std::vector<std::vector<double>>
        columns;                    ///< numbers, then optional: not a number where none is
    std::vector<std::size_t> line;  ///< of the file, from 1, by row
    std::vector<std::string> label; ///< words of the labels together, by row; empty: none
    std::vector<bool> after_gap;    ///< by row, whether an empty line stands before it

    std::size_t size() const { return line.size(); }
};

/// Reads a CSV file with a header: RFC 4180 with any line ends, in UTF-8 with or without its mark.
/// Blank lines, rows of empty cells and lines that begin with # are left out. Throws SceneError:
/// file, line, column, what is there and what is allowed.
CsvRows read_csv(const std::filesystem::path& file, const CsvColumns& wanted);

/// Refuses a file whose labels part its rows into several lines, where one is wanted: a label of a
/// single row is a point's. Throws SceneError.
/// @param what  that is one line, such as "a detachment"
void require_one_line(const CsvRows& rows, const std::filesystem::path& file,
                      std::string_view what);

/// Whether the header has a column. Throws SceneError if the file cannot be read.
bool csv_has_column(const std::filesystem::path& file, std::string_view name);

} // namespace listric
