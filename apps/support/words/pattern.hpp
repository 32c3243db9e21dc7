#pragma once

#include <optional>
#include <string>
#include <vector>

// Regular expressions, ECMAScript's. std::regex takes seconds to compile, so one unit has it.

namespace listric {

/// Whether a whole text is as an expression has it.
bool is_match(const std::string& text, const char* expression);
bool is_match_in_any_case(const std::string& text, const char* expression);

/// The whole text and the parts that groups of an expression match; none: the text does not match.
std::optional<std::vector<std::string>> parts_of(const std::string& text, const char* expression);

/// Part of a text.
struct Found {
    std::size_t begin, size;
};

/// What of a text matches, in its order.
std::vector<Found> find_all(const std::string& text, const char* expression);

} // namespace listric
