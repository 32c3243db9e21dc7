#pragma once

#include <cstddef>
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

} // namespace listric
