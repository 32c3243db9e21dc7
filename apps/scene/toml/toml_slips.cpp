#include "apps/scene/toml/toml_slips.hpp"

#include "apps/support/words/number.hpp"
#include "apps/support/words/pattern.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace listric {

namespace {

constexpr std::size_t longest_slip = 200; ///< bytes of a line; expressions must not go deep

/// A unit that people write, and how many of those that end a key it is.
struct WrittenUnit {
    std::string_view end, word;
    double factor;
};

constexpr WrittenUnit written_units[] = {
    {"_m", "km", 1e3},    {"_m", "m", 1.0},     {"_m", "cm", 1e-2},  {"_m", "mm", 1e-3},
    {"_m", "ft", 0.3048}, {"_a", "Ma", 1e6},    {"_a", "Myr", 1e6},  {"_a", "ka", 1e3},
    {"_a", "kyr", 1e3},   {"_a", "a", 1.0},     {"_a", "yr", 1.0},   {"_a", "years", 1.0},
    {"_pa", "GPa", 1e9},  {"_pa", "MPa", 1e6},  {"_pa", "kPa", 1e3}, {"_pa", "Pa", 1.0},
    {"_s", "s", 1.0},     {"_deg", "deg", 1.0}, {"_deg", "°", 1.0},
};

/// "figures_at_m" of "output.figures_at_m[0]".
std::string_view last_key(std::string_view path) {
    const std::string_view last = path.substr(path.rfind('.') + 1);
    return last.substr(0, last.find('['));
}

/// "10 km" in units of a key.
std::optional<double> in_unit_of(std::string_view key, const std::string& value) {
    const auto parts = parts_of(value, "([+-]?[0-9]+(?:[.,][0-9]*)?(?:[eE][+-]?[0-9]+)?) *(\\S+)");
    if (key.find("_per_") != key.npos || !parts)
        return std::nullopt;
    std::string digits = (*parts)[1];
    std::ranges::replace(digits, ',', '.');
    const auto number = parse_number(digits);
    const std::string word = (*parts)[2];
    for (const WrittenUnit& unit : written_units)
        if (number && key.ends_with(unit.end) && word == unit.word)
            return *number * unit.factor;
    return std::nullopt;
}

/// A value of a line that looks like a text: between quotes of typography or without any.
std::string bare_text(std::string value) {
    for (const std::string_view mark : {"“", "”", "„", "‘", "’", "«", "»"})
        for (auto at = value.find(mark); at != value.npos; at = value.find(mark))
            value.erase(at, mark.size());
    return value;
}

std::string cure_of_value(const std::string& key, const std::string& value) {
    const std::string bare = bare_text(value);
    if (bare != value && bare.find_first_of("\"'\\") == bare.npos)
        return fmt::format("; quotes of typography are no quotes; write {} = \"{}\"", key, bare);
    if (value.starts_with('"') && value.find('\\') != value.npos &&
        value.find('\'') == value.npos && value.find('"', 1) == value.size() - 1)
        return fmt::format("; a backslash in \"...\" begins a code; write {} = '{}'", key,
                           value.substr(1, value.size() - 2));
    if (is_match(value, "True|TRUE|Yes|yes|on") || is_match(value, "False|FALSE|No|no|off"))
        return fmt::format("; write {} = {}", key,
                           is_match(value, "True|TRUE|Yes|yes|on") ? "true" : "false");
    if (!value.empty() && value.find_first_of("0123456789") == value.find_first_not_of("+-."))
        return cure_of_number(key, value);
    // Brackets and quotes belong to a value of several parts, whose slip is within.
    if (!value.empty() && value.find_first_of("[]{}\"'=,") == value.npos)
        return fmt::format("; a text needs quotes; write {0} = {1}{2}{1}", key,
                           value.find('\\') == value.npos ? '"' : '\'', value);
    return "";
}

} // namespace

std::string cure_of_number(std::string_view path, std::string_view given) {
    const std::string value(given.substr(0, longest_slip));
    const std::string_view key = last_key(path);
    if (const auto number = in_unit_of(key, value))
        return fmt::format("; write {} = {}", key, text(*number));
    if (const auto number = parse_number(value))
        return fmt::format("; write {} = {}", key, text(*number));
    if (value.find_first_of("0123456789") == value.npos)
        return "";
    const std::string what = number_objection(value);
    return what.empty() ? "" : fmt::format("; this is {}", what);
}

std::string cure_of_line(std::string_view document, std::size_t line) {
    for (; line > 1 && !document.empty(); --line)
        document.remove_prefix(std::min(document.find('\n'), document.size() - 1) + 1);
    const std::string text(document.substr(0, document.find_first_of("\r\n")));
    if (text.size() > longest_slip)
        return "";
    const auto parts = parts_of(text, "\\s*([A-Za-z0-9_.-]+)\\s*=\\s*(.*?)\\s*(#.*)?");
    return parts ? cure_of_value((*parts)[1], (*parts)[2]) : "";
}

namespace {

/// The end of a string that begins at `begin` with a quote; of one line, unless it has three.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const auto is_triple = [&](std::size_t k) {
        return text.size() - k >= 3 && text[k] == quote && text[k + 1] == quote &&
               text[k + 2] == quote;
    };
    const bool is_long = is_triple(begin);
    for (std::size_t k = begin + (is_long ? 3 : 1); k < text.size(); ++k) {
        if (quote == '"' && text[k] == '\\')
            ++k;
        else if (!is_long && (text[k] == quote || text[k] == '\n'))
            return k + (text[k] == quote);
        else if (is_long && is_triple(k)) {
            k += 3;
            for (int more = 0; more < 2 && k < text.size() && text[k] == quote; ++more)
                ++k; // quotes of the string before those that end it
            return k;
        }
    }
    return text.size();
}

} // namespace

std::optional<std::size_t> too_deep_line(std::string_view text) {
    std::size_t line = 1, depth = 0, dots = 0;
    for (std::size_t k = 0; k < text.size();) {
        const char c = text[k];
        std::size_t next = k + 1;
        if (c == '"' || c == '\'')
            next = end_of_string(text, k);
        else if (c == '#')
            next = std::min(text.find('\n', k), text.size());
        else if (c == '.')
            ++dots;
        else if (c == '[' || c == '{')
            ++depth;
        else if ((c == ']' || c == '}') && depth > 0)
            --depth;
        if (c == '[' || c == ']' || c == '{' || c == '}' || c == '=' || c == ',' || c == '\n')
            dots = 0; // of the key that begins
        if (depth > deepest_toml || dots > deepest_toml)
            return line;
        line += static_cast<std::size_t>(std::count(text.data() + k, text.data() + next, '\n'));
        k = next;
    }
    return std::nullopt;
}

} // namespace listric
