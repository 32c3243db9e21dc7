#include "apps/support/files/csv.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/csv_header.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/reading.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t largest_file = 256 << 20; ///< bytes, all of which are read at once
constexpr std::size_t most_rows = 5'000'000;

struct Delimiter {
    std::string_view word;
    char sign;
};

constexpr std::array<Delimiter, 4> delimiters{
    {{",", ','}, {";", ';'}, {"tab", '\t'}, {"blank", ' '}}};

/// Bytes of a file that could hold a table.
std::string bytes_of(const fs::path& path) {
    const std::string name = shown(path.string());
    const auto fail = [&](std::string_view why) {
        refuse(name, fmt::format("cannot be read: {}", why));
    };
    std::error_code error;
    const fs::file_status status = status_of(path, error);
    if (!fs::exists(status))
        fail(error ? error.message() : std::strerror(ENOENT));
    if (!fs::is_regular_file(status)) // a pipe may never end
        refuse(name, "is no regular file; needs a table in CSV");
    std::optional<std::string> bytes = first_bytes(path, largest_file + 1);
    if (!bytes)
        fail(std::strerror(errno));
    if (bytes->size() > largest_file)
        refuse(name, "has more than 256 MB, allowed: at most that; keep every n-th row");
    return std::move(*bytes);
}

/// Kind of a file that is no text in UTF-8, by its first bytes.
std::string other_format(std::string_view bytes) {
    using namespace std::literals;
    if (bytes.starts_with("\xff\xfe\0\0"sv) || bytes.starts_with("\0\0\xfe\xff"sv))
        return "UTF-32";
    const bool in_pairs = bytes.size() > 3 && ((bytes[1] == '\0' && bytes[3] == '\0') ||
                                               (bytes[0] == '\0' && bytes[2] == '\0'));
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff") || in_pairs)
        return "UTF-16";
    if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("\xd0\xcf\x11\xe0"))
        return "a workbook of a spreadsheet or an archive";
    if (bytes.starts_with("\x1f\x8b") || bytes.starts_with("BZh") ||
        bytes.starts_with("\xfd"
                          "7zXZ"))
        return "compressed";
    return "";
}

/// The text of a file, whatever wrote it.
std::string decoded_text(const fs::path& path) {
    std::string text = bytes_of(path);
    if (const std::string format = other_format(text); !format.empty())
        refuse(shown(path.string()), fmt::format("is {}; save it as CSV UTF-8", format));
    if (text.starts_with("\xef\xbb\xbf")) // as spreadsheets write it
        text.erase(0, 3);
    if (const auto bad = unsound_byte(text)) {
        const std::size_t begin =
            std::max(*bad - std::min<std::size_t>(*bad, 10), text.find_last_of("\r\n", *bad) + 1);
        const std::size_t end =
            std::min({*bad + 10, text.find_first_of("\r\n", *bad), text.size()});
        refuse(csv_place(path.string(), line_of(text, *bad)),
               fmt::format("\"{}\" has the byte {}, which is {}; save the file as CSV UTF-8",
                           shown(text.substr(begin, end - begin)), shown(text.substr(*bad, 1)),
                           text[*bad] == '\0' ? "no text" : "no UTF-8"));
    }
    if (text.starts_with("sep=")) // a spreadsheet's own line; the header says as much
        text[0] = '#';
    return text;
}

/// The first row, as a delimiter parts it.
CsvRecord header_of(std::string_view text, const std::string& file, char delimiter) {
    CsvRecord header;
    read_records(text, file, delimiter, [&](CsvRecord& record) {
        header = std::move(record);
        return false;
    });
    return header;
}

bool has(const CsvRecord& header, std::string_view name) {
    return std::ranges::find(header.cells, name) != header.cells.end();
}

/// A way to read the header: with the delimiter that finds most of the wanted columns.
struct Reading {
    Delimiter delimiter = delimiters[0];
    CsvRecord header;
    std::size_t found = 0;
};

Reading best_reading(std::string_view text, const std::string& file,
                     const std::vector<std::string_view>& names, std::string_view word) {
    std::optional<Reading> best;
    std::optional<SceneError> refusal;
    for (const Delimiter& delimiter : delimiters) {
        if (word != "auto" && word != delimiter.word)
            continue;
        try {
            Reading reading{delimiter, header_of(text, file, delimiter.sign), 0};
            reading.found = static_cast<std::size_t>(std::ranges::count_if(
                names, [&](std::string_view name) { return has(reading.header, name); }));
            if (!best || reading.found > best->found)
                best = std::move(reading);
        } catch (const SceneError& error) { // a quote that another delimiter may explain
            if (!refusal)
                refusal = error;
        }
    }
    if (!best)
        throw SceneError(*refusal);
    return *best;
}

/// Where a column is in the header; its size if it is not there.
std::size_t place_of(const CsvRecord& header, std::string_view name, const std::string& where) {
    const auto found = std::ranges::find(header.cells, name);
    if (found != header.cells.end() &&
        std::find(found + 1, header.cells.end(), name) != header.cells.end())
        refuse(where, fmt::format("has two columns {}; leave one out or rename it", name));
    return static_cast<std::size_t>(found - header.cells.begin());
}

/// A word in one line, without signs that a terminal obeys.
std::string word_of(const std::string& cell, const std::string& where, std::string_view column) {
    std::string word;
    for (const char letter : cell)
        if (letter != '\n' && letter != '\r' && letter != '\t')
            word += letter;
        else if (!word.empty() && word.back() != ' ')
            word += ' ';
    if (shown(word) != word)
        refuse(where, fmt::format("{}: \"{}\" has a control character; leave it out", column,
                                  shown_start(word)));
    return word;
}

/// Whether a row fits below its header; a spreadsheet may write empty cells behind it.
void check_width(const CsvRecord& record, const CsvRecord& header, const Delimiter& delimiter,
                 const std::string& file) {
    std::size_t width = record.cells.size();
    while (width > header.cells.size() && record.cells[width - 1].empty())
        --width;
    if (width > header.cells.size())
        refuse(csv_place(file, record.line),
               fmt::format("has {} cells, but the header {}; a cell with a {} in it needs quotes, "
                           "and numbers need a decimal point",
                           width, header.cells.size(),
                           delimiter.sign == ',' ? "comma" : delimiter.word));
}

/// Refuses a header whose column, which may be missing, is there under another name.
void check_optional(const CsvRecord& header, std::string_view name, const std::string& where) {
    if (has(header, name))
        return;
    if (const std::string hint = optional_hint(header.cells, name); !hint.empty())
        refuse(where, fmt::format("has no column {}, which may be left out; it has {}{}", name,
                                  header_text(header.cells), hint));
}

/// Places of the labels that the header has.
std::vector<std::size_t> label_places(const CsvRecord& header, const CsvColumns& wanted) {
    std::vector<std::size_t> places;
    for (const std::string_view label : wanted.labels)
        for (std::size_t k = 0; k < header.cells.size(); ++k)
            if (std::ranges::equal(header.cells[k], label, {}, [](char letter) {
                    return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
                }))
                places.push_back(k);
    return places;
}

/// The cells of some columns, with commas.
std::string label_of(const CsvRecord& record, const std::vector<std::size_t>& places) {
    std::string label;
    for (const std::size_t place : places)
        if (!record.cells[place].empty())
            label += fmt::format("{}{}", label.empty() ? "" : ", ", record.cells[place]);
    return label;
}

std::vector<std::string_view> needed_columns(const CsvColumns& wanted) {
    std::vector<std::string_view> names;
    if (!wanted.words.empty())
        names.push_back(wanted.words);
    names.insert(names.end(), wanted.numbers.begin(), wanted.numbers.end());
    return names;
}

/// The header with all that is needed.
Reading read_header(std::string_view text, const std::string& file, const CsvColumns& wanted) {
    const std::vector<std::string_view> names = needed_columns(wanted);
    Reading reading = best_reading(text, file, names, wanted.delimiter);
    if (reading.header.cells.empty())
        refuse(shown(file), fmt::format("has no header, needs {}", fmt::join(names, ", ")));
    if (reading.found == names.size())
        return reading;
    const std::string where = csv_place(file, reading.header.line);
    const auto missing =
        std::ranges::find_if_not(names, [&](auto name) { return has(reading.header, name); });
    std::string hint = header_hint(reading.header.cells, *missing, names, text);
    if (wanted.delimiter != "auto")
        if (const Reading other = best_reading(text, file, names, "auto");
            other.found > reading.found)
            hint = fmt::format("; its columns seem to be parted by {0}; give csv_delimiter = "
                               "\"{0}\", or leave it out",
                               other.delimiter.word);
    refuse(where, fmt::format("has no column {}, needs a header with {}; it has {}{}", *missing,
                              fmt::join(names, ", "), header_text(reading.header.cells), hint));
}

} // namespace

std::vector<std::string_view> csv_delimiters() {
    std::vector<std::string_view> words{"auto"};
    for (const Delimiter& delimiter : delimiters)
        words.push_back(delimiter.word);
    return words;
}

CsvRows read_csv(const fs::path& path, const CsvColumns& wanted) {
    const std::string file = path.string(), text = decoded_text(path);
    const Reading reading = read_header(text, file, wanted);
    const CsvRecord& header = reading.header;
    std::vector<std::string_view> names = wanted.numbers;
    names.insert(names.end(), wanted.optional.begin(), wanted.optional.end());
    for (const std::string_view name : wanted.optional)
        check_optional(header, name, csv_place(file, header.line));
    std::vector<std::size_t> place;
    for (const std::string_view name : names)
        place.push_back(place_of(header, name, csv_place(file, header.line)));
    const std::size_t words =
        wanted.words.empty() ? 0 : place_of(header, wanted.words, csv_place(file, header.line));
    const std::vector<std::size_t> labels = label_places(header, wanted);

    CsvRows rows{{}, std::vector<std::vector<double>>(names.size()), {}, {}, {}};
    bool below = false;
    read_records(text, file, reading.delimiter.sign, [&](CsvRecord& record) {
        if (!std::exchange(below, true))
            return true;
        check_width(record, header, reading.delimiter, file);
        record.cells.resize(std::max(record.cells.size(), header.cells.size() + 1));
        const auto where = [&] { return csv_place(file, record.line); };
        if (!wanted.words.empty())
            rows.words.push_back(word_of(record.cells[words], where(), wanted.words));
        for (std::size_t k = 0; k < names.size(); ++k) {
            const std::string& cell = record.cells[place[k]];
            if (cell.empty() && k >= wanted.numbers.size()) {
                rows.columns[k].push_back(std::numeric_limits<double>::quiet_NaN());
                continue;
            }
            const auto value = parse_number(cell);
            if (!value)
                refuse(where(), fmt::format("{}: {}", names[k], no_number(cell)));
            rows.columns[k].push_back(*value);
        }
        rows.line.push_back(record.line);
        rows.label.push_back(label_of(record, labels));
        rows.after_gap.push_back(record.after_gap);
        if (rows.line.size() > most_rows)
            refuse(where(), fmt::format("has more than {} rows; keep every n-th", most_rows));
        return true;
    });
    if (rows.line.empty())
        refuse(shown(file),
               fmt::format("has no rows, needs {}", fmt::join(needed_columns(wanted), ", ")));
    return rows;
}

void require_one_line(const CsvRows& rows, const fs::path& file, std::string_view what) {
    std::map<std::string, std::size_t> sizes;
    for (const std::string& label : rows.label)
        ++sizes[label];
    const std::string* first = nullptr;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (sizes[rows.label[k]] < 2)
            continue;
        if (first && *first != rows.label[k])
            refuse(
                csv_place(file.string(), rows.line[k]),
                fmt::format("begins the line \"{}\" after the line \"{}\"; {} is one line: leave "
                            "the rows of the others out",
                            shown_start(rows.label[k]), shown_start(*first), what));
        first = &rows.label[k];
    }
}

bool csv_has_column(const fs::path& path, std::string_view name) {
    const std::string text = decoded_text(path);
    return best_reading(text, path.string(), {name}, "auto").found > 0;
}

} // namespace listric
