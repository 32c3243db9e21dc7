#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// A row of a CSV file, whose cells are without their quotes and the blanks around.
struct CsvRecord {
    std::vector<std::string> cells;
    std::size_t line = 0;   ///< of the file, from 1, on which it begins
    bool after_gap = false; ///< an empty line, or a row of empty cells, stands before it

    bool is_empty() const; ///< a spreadsheet's row without a word
};

/// Takes a text apart as RFC 4180 has it, with any line ends, and hands on its records until `take`
/// says no; blank lines and those that begin with # outside of quotes are left out. Throws
/// SceneError with the file's name and the line.
/// @param delimiter  between cells; ' ' is any number of blanks and tabs
void read_records(std::string_view text, const std::string& file, char delimiter,
                  const std::function<bool(CsvRecord&)>& take);

/// A text as one cell, in quotes where it needs them.
std::string csv_cell(const std::string& text);

/// "file:line", as a message may hold it.
std::string csv_place(const std::string& file, std::size_t line);

/// The number of the line on which a byte is.
std::size_t line_of(std::string_view text, std::size_t byte);

} // namespace listric
