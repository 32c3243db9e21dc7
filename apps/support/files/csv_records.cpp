#include "apps/support/files/csv_records.hpp"

#include "apps/support/error.hpp"
#include "apps/support/words/text.hpp"

#include <csv.h>
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

/// libcsv's parser with the record that it is at.
class Parser {
public:
    explicit Parser(char delimiter) {
        if (csv_init(&parser_, CSV_STRICT) != 0)
            throw std::bad_alloc();
        csv_set_delim(&parser_, static_cast<unsigned char>(delimiter));
        csv_set_blk_size(&parser_, 4096);
    }
    ~Parser() { csv_free(&parser_); }
    Parser(const Parser&) = delete;
    Parser& operator=(const Parser&) = delete;

    /// Takes a line; false where a quote stands where none may.
    bool take(std::string_view line) {
        const bool good = csv_parse(&parser_, line.data(), line.size(), &take_cell, &end_record,
                                    this) == line.size();
        if (!good && csv_error(&parser_) == CSV_ENOMEM)
            throw std::bad_alloc();
        return good;
    }

    CsvRecord record;
    bool ended = false;

private:
    // An exception must not cross a library in C, so cells are bounded by their lines.
    static void take_cell(void* bytes, std::size_t size, void* self) {
        auto& cells = static_cast<Parser*>(self)->record.cells;
        if (cells.size() <= most_cells)
            cells.emplace_back(static_cast<const char*>(bytes), size);
    }
    static void end_record(int, void* self) { static_cast<Parser*>(self)->ended = true; }

    csv_parser parser_{};
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
    std::string cell(2 * text.size() + 2, '\0');
    cell.resize(csv_write(cell.data(), cell.size(), text.data(), text.size()));
    return cell;
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
