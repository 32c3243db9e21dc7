#include "apps/support/files/csv_header.hpp"

#include "apps/support/words/number.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>

namespace listric {

namespace {

/// "Depth [km]" as a name of ours: depth_km.
std::string plain(std::string_view cell) {
    std::string name;
    for (const char letter : cell) {
        const auto sign = static_cast<unsigned char>(letter);
        if (std::isalnum(sign))
            name += static_cast<char>(std::tolower(sign));
        else if (!name.empty() && name.back() != '_')
            name += '_';
    }
    while (name.ends_with('_'))
        name.pop_back();
    return name;
}

/// The line of names that stands behind a # at the head of the file.
bool is_behind_hash(std::string_view text, std::string_view name) {
    while (text.starts_with('#')) {
        const auto end = std::min(text.find_first_of("\r\n"), text.size());
        if (text.substr(0, end).find(name) != text.npos)
            return true;
        text.remove_prefix(std::min(text.find_first_not_of("\r\n", end), text.size()));
    }
    return false;
}

/// The number of a line further down that has all names; 0 if none of the first does.
std::size_t line_of_names(std::string_view text, const std::vector<std::string_view>& names) {
    constexpr std::size_t furthest = 50;
    for (std::size_t line = 1; line <= furthest && !text.empty(); ++line) {
        const auto end = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view words = text.substr(0, end);
        if (std::ranges::all_of(names, [&](auto name) { return words.find(name) != words.npos; }))
            return line;
        text.remove_prefix(
            std::min(end + (text.substr(end).starts_with("\r\n") ? 2 : 1), text.size()));
    }
    return 0;
}

constexpr const char* lengths = "1 km = 1000 m, 1 ft = 0.3048 m";
constexpr const char* times = "1 Ma = 1e6 a, 1 ka = 1000 a";

/// Whether a column of ours ends so in files of others.
bool is_unit(std::string_view word) {
    static constexpr std::string_view units[] = {
        "km", "m",  "cm", "mm", "ft",  "feet", "metres", "meters", "ga",  "ma",   "ka",   "a",
        "my", "ky", "gy", "y",  "myr", "kyr",  "gyr",    "yr",     "yrs", "year", "years"};
    return std::ranges::find(units, word) != std::end(units);
}

/// Cure of a cell that is the name of a missing column without its unit, with another one, or in
/// another spelling; empty: it is none of these.
std::string unit_hint(const std::string& cell, std::string_view missing) {
    const std::string column = plain(cell);
    if (column == missing)
        return fmt::format("; did you mean {} by \"{}\"? write it so", missing, shown_start(cell));
    const std::size_t unit = missing.rfind('_');
    if (unit == missing.npos)
        return "";
    const std::string_view stem = missing.substr(0, unit); // "depth" of "depth_m"
    if (column == stem)
        return fmt::format("; call {} {} if it is in that unit", shown_start(cell), missing);
    if (!column.starts_with(fmt::format("{}_", stem)) ||
        column.find('_', stem.size() + 1) != column.npos)
        return "";
    const std::string_view other = std::string_view(column).substr(stem.size() + 1);
    const bool is_time = missing.ends_with("_a");
    static constexpr std::string_view same_length[] = {"metres", "meters"},
                                      same_time[] = {"y", "yr", "yrs", "year", "years"};
    const bool is_same = is_time ? std::ranges::find(same_time, other) != std::end(same_time)
                                 : std::ranges::find(same_length, other) != std::end(same_length);
    return is_same ? fmt::format("; call {} {} if it is in that unit", shown_start(cell), missing)
                   : fmt::format("; {} is in another unit ({})", shown_start(cell),
                                 is_time ? times : lengths);
}

} // namespace

std::string header_text(const std::vector<std::string>& header) {
    return shown_start(fmt::format("{}", fmt::join(header, ", ")), 200);
}

std::string header_hint(const std::vector<std::string>& header, std::string_view missing,
                        const std::vector<std::string_view>& needed, std::string_view text) {
    if (is_behind_hash(text, missing))
        return "; the names stand behind a #, leave it out";
    if (const std::size_t line = line_of_names(text, needed); line > 1)
        return fmt::format("; line {} seems to have them, put a # before what stands above", line);
    if (std::ranges::all_of(header,
                            [](const auto& cell) { return parse_number(cell).has_value(); }))
        return fmt::format("; put a line with the names, {}, above the numbers",
                           fmt::join(needed, ","));
    for (const std::string& cell : header)
        if (std::string hint = unit_hint(cell, missing); !hint.empty())
            return hint;
    const bool is_down = missing == "depth_m";
    if (is_down || missing == "y_m")
        for (const std::string& cell : header)
            if (const std::string name = plain(cell); name == "z" || name == "z_m")
                return fmt::format(
                    "; if {} is what is meant, call it {}, in metres and positive {}",
                    shown_start(cell), missing, is_down ? "down" : "up");
    for (const std::string& cell : header)
        if (const auto meant = nearest(cell, needed); meant && *meant == missing)
            return fmt::format("; did you mean {} by \"{}\"?", missing, shown_start(cell));
    return "";
}

std::string optional_hint(const std::vector<std::string>& header, std::string_view missing) {
    const std::string_view stem = missing.substr(0, missing.rfind('_'));
    for (const std::string& cell : header) {
        const std::string column = plain(cell);
        const bool has_unit = column.starts_with(fmt::format("{}_", stem)) &&
                              is_unit(std::string_view(column).substr(stem.size() + 1));
        if (column == stem || has_unit)
            return unit_hint(cell, missing);
    }
    return "";
}

} // namespace listric
