#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace listric {

/// How deep brackets may stand in each other, and how many dots a key may have: more than any file
/// needs. toml++ bounds only the first, and its tables end, as they are made, one call in another.
inline constexpr std::size_t deepest_toml = 32;

/// The line, from 1, at which a text of TOML is nested deeper than that; none: nowhere. What is no
/// TOML is judged as far as it goes.
std::optional<std::size_t> too_deep_line(std::string_view text);

} // namespace listric
