#include "apps/support/csv.hpp"

#include "apps/support/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

namespace listric {

namespace {

std::vector<std::string> cells_of(const std::string& line, char delimiter) {
    std::vector<std::string> cells(1);
    for (char letter : line) {
        if (letter == delimiter)
            cells.emplace_back();
        else if (letter != '\r' && letter != '"')
            cells.back() += letter;
    }
    for (std::string& cell : cells) {
        cell.erase(0, cell.find_first_not_of(" \t"));
        cell.erase(cell.find_last_not_of(" \t") + 1);
    }
    return cells;
}

bool is_blank(const std::string& line) {
    const auto first = line.find_first_not_of(" \t\r");
    return first == line.npos || line[first] == '#';
}

std::optional<double> number(const std::string& cell) {
    double value = 0.0;
    const char* end = cell.data() + cell.size();
    const auto [stopped, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc{} || stopped != end || !std::isfinite(value))
        return std::nullopt;
    return value;
}

/// The lines of a file that say something.
class Lines {
public:
    Lines(const std::filesystem::path& path, char delimiter)
        : path_(path), file_(path, std::ios::binary), delimiter_(delimiter) {
        if (!file_.is_open())
            fail();
    }

    std::optional<std::vector<std::string>> next() {
        for (std::string line; std::getline(file_, line);) {
            if (++number_ == 1 && line.starts_with("\xef\xbb\xbf")) // as spreadsheets write it
                line.erase(0, 3);
            if (!is_blank(line))
                return cells_of(line, delimiter_);
        }
        if (file_.bad())
            fail();
        return std::nullopt;
    }

    std::size_t number() const { return number_; }

    [[noreturn]] void refuse(std::string_view what) const {
        throw SceneError(fmt::format("{}:{}: {}", path_.string(), number_, what));
    }

private:
    [[noreturn]] void fail() const {
        throw SceneError(
            fmt::format("{}: cannot be read: {}", path_.string(), std::strerror(errno)));
    }

    std::filesystem::path path_;
    std::ifstream file_;
    char delimiter_;
    std::size_t number_ = 0;
};

/// What may be wrong with a header that lacks a column.
std::string hint(const std::vector<std::string>& header, std::string_view name, char delimiter) {
    for (const char other : {',', ';'})
        if (other != delimiter && header.size() == 1 && header[0].find(other) != std::string::npos)
            return fmt::format("; its columns seem to be parted by {}", other);
    const std::string_view stem = name.substr(0, name.rfind('_') + 1); // "depth_" of "depth_m"
    for (const std::string& cell : header)
        if (stem.size() > 1 && cell.starts_with(stem) && cell.size() > stem.size())
            return fmt::format("; {} is in another unit (1 km = 1000 m, 1 ft = 0.3048 m)", cell);
    return "";
}

} // namespace

CsvRows read_csv(const std::filesystem::path& path, std::span<const std::string_view> columns,
                 char delimiter) {
    Lines lines(path, delimiter);
    const auto header = lines.next();
    std::vector<std::size_t> place;
    for (const std::string_view name : columns) {
        if (!header)
            break;
        place.push_back(
            static_cast<std::size_t>(std::ranges::find(*header, name) - header->begin()));
        if (place.back() == header->size())
            lines.refuse(fmt::format("has no column {}, needs a header with {}; it has {}{}", name,
                                     fmt::join(columns, ", "), fmt::join(*header, ", "),
                                     hint(*header, name, delimiter)));
    }
    CsvRows rows{std::vector<std::vector<double>>(columns.size()), {}};
    while (const auto row = lines.next()) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const std::string cell = place[k] < row->size() ? (*row)[place[k]] : "";
            const auto value = number(cell);
            if (!value)
                lines.refuse(fmt::format("{}: \"{}\" is not a finite number", columns[k], cell));
            rows.columns[k].push_back(*value);
        }
        rows.line.push_back(lines.number());
    }
    if (rows.line.empty())
        throw SceneError(fmt::format("{}: has no {}, needs {}", path.string(),
                                     header ? "rows" : "header", fmt::join(columns, ", ")));
    return rows;
}

bool csv_has_column(const std::filesystem::path& path, std::string_view name) {
    const auto header = Lines(path, ',').next();
    return header && std::ranges::find(*header, name) != header->end();
}

std::vector<std::string> read_csv_words(const std::filesystem::path& path, std::string_view column,
                                        char delimiter) {
    Lines lines(path, delimiter);
    const auto header = lines.next();
    const std::size_t place =
        header ? static_cast<std::size_t>(std::ranges::find(*header, column) - header->begin()) : 0;
    if (!header || place == header->size())
        lines.refuse(
            fmt::format("has no column {}, needs a header with it{}", column,
                        header ? "; it has " + fmt::format("{}", fmt::join(*header, ", ")) : ""));
    std::vector<std::string> words;
    while (const auto row = lines.next())
        words.push_back(place < row->size() ? (*row)[place] : "");
    return words;
}

} // namespace listric
