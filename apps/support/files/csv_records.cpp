#include "apps/support/files/csv_records.hpp"

#include "apps/support/error.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace listric {

namespace {

constexpr std::size_t longest_record = 1 << 20; ///< bytes; what is longer is no row of a table
constexpr std::size_t most_cells = 10'000;

/// The length of the line that begins at `at`, with its end: LF, CR, or CRs and LF, which is one.
std::size_t line_length(std::string_view text, std::size_t at) {
    std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    if (end == text.size())
        return end - at;
    const std::size_t after = std::min(text.find_first_not_of('\r', end), text.size());
    if (after < text.size() && text[after] == '\n')
        return after + 1 - at;
    return end + 1 - at;
}

/// Its first character that is no blank; NUL: there is none.
char first_sign(std::string_view line) {
    const auto first = line.find_first_not_of(" \t\r\n\v\f");
    return first == line.npos ? '\0' : line[first];
}

/// A line whose columns blanks part, with one tab in place of each gap. @param quoted  it begins
/// within quotes
std::string with_tabs(std::string_view line, bool quoted) {
    std::string text;
    const auto last = line.find_last_not_of(" \t\r\n");
    for (std::size_t k = 0; k < line.size(); ++k) {
        const bool is_gap = !quoted && (line[k] == ' ' || line[k] == '\t');
        if (line[k] == '"')
            quoted = !quoted;
        if (!is_gap)
            text += line[k];
        else if (!text.empty() && text.back() != '\t' && last != line.npos && k < last)
            text += '\t';
    }
    return text;
}

/// Takes records apart as RFC 4180 has them, without the blanks around cells.
class Parser {
public:
    explicit Parser(char delimiter) : delimiter_(delimiter) {}

    /// Takes a line; false where a quote stands where none may.
    bool take(std::string_view line) {
        return std::ranges::all_of(line, [this](char sign) { return take(sign); });
    }

    CsvRecord record;
    bool ended = false;

private:
    /// What has been read of the present cell.
    enum class Part { none, plain, quoted, closed, closed_and_blank };

    bool take(char sign) {
        if (part_ == Part::quoted && sign != '"') {
            cell_ += sign;
            return true;
        }
        if (sign == '"') // opens a cell, closes it, or is the second of two, which stand for one
            return take_quote();
        if (sign == delimiter_ || sign == '\r' || sign == '\n') {
            if (!ended) // else it is the second sign of a line's end
                end_cell();
            ended |= sign != delimiter_;
            return true;
        }
        const bool is_closed = part_ == Part::closed || part_ == Part::closed_and_blank;
        if (sign == ' ' || sign == '\t') {
            if (part_ == Part::plain)
                cell_ += sign;
            else if (is_closed)
                part_ = Part::closed_and_blank;
            return true;
        }
        cell_ += sign;
        part_ = Part::plain;
        return !is_closed;
    }

    bool take_quote() {
        if (part_ == Part::closed)
            cell_ += '"';
        else if (part_ == Part::plain || part_ == Part::closed_and_blank)
            return false;
        part_ = part_ == Part::quoted ? Part::closed : Part::quoted;
        return true;
    }

    void end_cell() {
        if (part_ == Part::plain)
            cell_.erase(cell_.find_last_not_of(" \t") + 1);
        if (record.cells.size() <= most_cells)
            record.cells.push_back(cell_);
        cell_.clear();
        part_ = Part::none;
    }

    char delimiter_;
    std::string cell_ = {};
    Part part_ = Part::none;
};

} // namespace

bool CsvRecord::is_empty() const {
    return std::ranges::all_of(cells, [](const std::string& cell) { return cell.empty(); });
}

std::string csv_cell(const std::string& text) {
    const bool plain = text.find_first_of(",\"\r\n") == text.npos && !text.starts_with(' ') &&
                       !text.starts_with('\t') && !text.ends_with(' ') && !text.ends_with('\t');
    if (plain)
        return text;
    std::string cell = "\"";
    for (const char sign : text)
        cell.append(sign == '"' ? 2 : 1, sign);
    return cell + '"';
}

std::string csv_place(const std::string& file, std::size_t line) {
    return fmt::format("{}:{}", shown(file), line);
}

std::size_t line_of(std::string_view text, std::size_t byte) {
    std::size_t line = 1;
    for (std::size_t at = 0; at < text.size();) {
        at += line_length(text, at);
        if (byte < at)
            break;
        ++line;
    }
    return line;
}

void read_records(std::string_view text, const std::string& file, char delimiter,
                  const std::function<bool(CsvRecord&)>& take) {
    Parser parser(delimiter == ' ' ? '\t' : delimiter);
    std::size_t line = 0, quote_line = 0, bytes = 0;
    bool gap = false;
    const auto refuse = [&](std::size_t at, const std::string& what) {
        throw SceneError(fmt::format("{}: {}", csv_place(file, at), what));
    };
    for (std::size_t at = 0, length = 0; at < text.size(); at += length) {
        length = line_length(text, at);
        std::string_view part = text.substr(at, length);
        ++line;
        const bool continues = quote_line > 0;
        if (const char first = first_sign(part); !continues && (first == '\0' || first == '#')) {
            gap |= first == '\0';
            continue;
        }
        if (!continues) {
            parser.record = {.cells = {}, .line = line};
            bytes = 0;
        }
        bytes += length;
        if (bytes > longest_record)
            refuse(continues ? quote_line : line,
                   continues ? "the quote that begins here is not closed; close it or leave it out"
                             : "the line has more than 1 MB; this is no table of rows");
        const std::string tabbed = delimiter == ' ' ? with_tabs(part, continues) : "";
        if (delimiter == ' ')
            part = tabbed;
        const std::size_t cells = parser.record.cells.size();
        parser.ended = false;
        const bool last = at + length == text.size();
        bool good = parser.take(part);
        if (good && last && !parser.ended) // the end of the file ends a line
            good = parser.take("\n");
        if (!good)
            refuse(continues ? quote_line : line,
                   continues ? fmt::format("the quoted cell that begins here is closed on line {} "
                                           "and goes on behind its quote; a quote is missing",
                                           line)
                             : "a quote within a cell; put the whole cell in quotes and write two "
                               "for each one in it, or leave it out");
        if (parser.record.cells.size() > most_cells)
            refuse(line, fmt::format("has more than {} cells", most_cells));
        if (!parser.ended) {
            if (!continues || parser.record.cells.size() != cells)
                quote_line = line;
            continue;
        }
        quote_line = 0;
        const bool is_empty = parser.record.is_empty();
        parser.record.after_gap = std::exchange(gap, is_empty);
        if (!is_empty && !take(parser.record))
            return;
    }
    if (quote_line > 0)
        refuse(quote_line, "the quote that begins here is not closed; close it or leave it out");
}

} // namespace listric
