#pragma once

#include <string_view>

namespace listric::archive {

/// A line of TOML without its comment and the blanks before it.
std::string_view without_comment(std::string_view line);

} // namespace listric::archive
