#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// Slips that people make in TOML, and their cures: "; write distance_m = 10000".

namespace listric {

/// Cure of a text in the place of a number: of a decimal comma, a unit behind it, or quotes. Empty
/// where nobody can tell.
/// @param key  with its table, if any; its end is the unit
std::string cure_of_number(std::string_view key, std::string_view text);

/// Cure of a line, from 1, of a document that the parser refuses. Empty where nobody can tell.
std::string cure_of_line(std::string_view document, std::size_t line);

/// How deep brackets may stand in each other, and how many dots a key may have: more than any file
/// needs. toml++ bounds only the first, and its tables end, as they are made, one call in another.
inline constexpr std::size_t deepest_toml = 32;

/// The line, from 1, at which a text of TOML is nested deeper than that; none: nowhere. What is no
/// TOML is judged as far as it goes.
std::optional<std::size_t> too_deep_line(std::string_view text);

} // namespace listric
