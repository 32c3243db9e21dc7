#include "apps/support/words/number.hpp"

#include "apps/support/words/pattern.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace listric {

namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const auto first = text.find_first_not_of(blanks);
    if (first == text.npos)
        return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Whether digits that no double can hold are too near to zero, not too large.
bool is_tiny(std::string_view digits) {
    const auto exponent = digits.find('e');
    if (exponent != digits.npos)
        return digits.substr(exponent).starts_with("e-");
    return digits.find_first_of("123456789") > digits.find('.');
}

std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
    std::string result;
    for (auto at = text.find(what); at != text.npos; at = text.find(what)) {
        result.append(text.substr(0, at)).append(by);
        text.remove_prefix(at + what.size());
    }
    return result.append(text);
}

std::string without(std::string text, std::string_view letters) {
    std::erase_if(text, [&](char letter) { return letters.find(letter) != letters.npos; });
    return text;
}

/// Meaning of a word in the place of a number.
std::string word_objection(const std::string& text) {
    if (is_match_in_any_case(
            text, "[+-]?nan(\\(.*\\))?|#?n/?a|null|none|nil|no ?data|missing|-+|\\?+|x+"))
        return "no value; leave out what has none";
    if (is_match_in_any_case(text, "[+-]?inf(inity)?"))
        return "infinity";
    if (is_match_in_any_case(text, "#[a-z0-9/]+[!?]|#+|err:?[0-9]*"))
        return "an error of a spreadsheet, or a column too narrow for its number";
    if (is_match_in_any_case(text, "\\*+"))
        return "what Fortran writes where a number does not fit its width";
    if (is_match_in_any_case(text, "[+-]?0x[0-9a-f.]+(p[+-]?[0-9]+)?"))
        return "hexadecimal; write decimal digits";
    return "";
}

/// Objection to digits that commas, blanks or other marks part.
std::string marks_objection(const std::string& text) {
    if (is_match_in_any_case(text, "[+-]?[0-9]{1,3},[0-9]{3}"))
        return fmt::format("a decimal comma, or one between thousands; write {} or {}",
                           replaced(text, ",", "."), without(text, ","));
    if (is_match_in_any_case(text, "[+-]?[0-9]*,[0-9]+([ed][+-]?[0-9]+)?"))
        return fmt::format("a decimal comma; write {}", replaced(text, ",", "."));
    if (is_match_in_any_case(text, "[+-]?[0-9]{1,3}(,[0-9]{3})+(\\.[0-9]*)?"))
        return fmt::format("commas between thousands; write {}", without(text, ","));
    if (is_match_in_any_case(text, "[+-]?[0-9]{1,3}(\\.[0-9]{3})+,[0-9]*"))
        return fmt::format("a decimal comma, and points between thousands; write {}",
                           replaced(without(text, "."), ",", "."));
    if (is_match_in_any_case(text, "[0-9]{1,4}[./-][0-9]{1,2}[./-][0-9]{1,4}"))
        return "a date";
    if (is_match_in_any_case(text, "[+-]?[0-9]{1,3}(\\.[0-9]{3}){2,}"))
        return fmt::format("points between thousands; write {}", without(text, "."));
    if (is_match_in_any_case(text, "[+-]?[0-9]{1,3}([ '_][0-9]{3})+([.,][0-9]*)?"))
        return fmt::format("marks between thousands; write {}",
                           replaced(without(text, " '_"), ",", "."));
    return "";
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
    std::string_view number = trimmed(text);
    if (number.starts_with('+') && number.find_first_of("0123456789.") == 1)
        number.remove_prefix(1);
    constexpr std::size_t longest = 2000; // a text with more digits is no number
    if (number.empty() || number.size() > longest)
        return std::nullopt;
    std::string digits(number);
    std::ranges::transform(digits, digits.begin(),
                           [](char c) { return c == 'd' || c == 'D' || c == 'E' ? 'e' : c; });
    double value = 0.0;
    const char* const end = digits.data() + digits.size();
    const auto [stopped, error] = std::from_chars(digits.data(), end, value);
    if (stopped != end)
        return std::nullopt;
    if (error == std::errc::result_out_of_range && is_tiny(digits))
        return 0.0;
    return error == std::errc{} && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string number_objection(std::string_view given) {
    constexpr std::size_t longest = 60; // expressions must not go deep
    std::string text(trimmed(given));
    if (text.empty())
        return "empty";
    if (text.size() > longest)
        return "";
    if (std::string said = word_objection(text); !said.empty())
        return said;
    const std::array<std::string_view, 3> dashes{"\u2212", "\u2013", "\u2014"};
    for (const std::string_view dash : dashes)
        if (text.starts_with(dash))
            return fmt::format("a minus sign or dash of typography; write -{}",
                               shown(text.substr(dash.size())));
    for (const std::string_view mark : {"\u00a0", "\u2009", "\u202f", "\u2019"})
        text = replaced(text, mark, mark == "\u2019" ? "'" : " "); // as people set thousands apart
    if (std::string said = marks_objection(text); !said.empty())
        return said;
    if (is_match_in_any_case(text, "[+-]?[0-9]*\\.?[0-9]+[+-][0-9]{2,3}"))
        return "an exponent without its letter, as Fortran writes it; write e before its sign";
    if (is_match_in_any_case(text, "[+-]?[0-9]*\\.?[0-9]*([ed][+-]?[0-9]+)?") &&
        text.find_first_of("0123456789") != text.npos)
        return "too large";
    if (const auto parts = parts_of(text, "([+-]?[0-9]+(?:[.,][0-9]*)?(?:[eE][+-]?[0-9]+)?) "
                                          "*((?:[a-zA-Z%/\"']|[\xc0-\xff][\x80-\xbf]+).*)"))
        return fmt::format("a number and {}; write the number alone, in the unit of the name",
                           shown((*parts)[2]));
    return "";
}

Length read_length(std::string_view given) {
    constexpr double most = 1e7; // m
    const std::string_view text = trimmed(given);
    const double unit = text.ends_with("km") ? 1e3 : 1.0;
    const std::size_t letters = unit > 1.0 ? 2 : text.ends_with('m') ? 1 : 0;
    const std::string_view number = text.substr(0, text.size() - letters);
    const auto value = parse_number(number);
    if (value && letters == 0 && *value > 0.0)
        return {0.0, fmt::format("a length needs its unit: {0}km or {0}m; a decimal comma is a "
                                 "point here",
                                 shown_start(number))};
    if (value && *value >= 0.0 && *value * unit <= most)
        return {*value * unit};
    std::string what = value ? "" : number_objection(number);
    if (const auto unknown = what.find("; write the number alone"); unknown != what.npos)
        what.erase(unknown); // units are km and m here
    return {0.0, fmt::format("a length of at least 0 with its unit, such as 5km or 500m{}",
                             what.empty() ? "" : "; this is " + what)};
}

std::string no_number(std::string_view text) {
    const std::string what = number_objection(text);
    return fmt::format("\"{}\" is not a finite number{}{}", shown_start(text),
                       what.empty() ? "" : ": ", what);
}

} // namespace listric
