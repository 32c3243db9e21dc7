#pragma once

#include <string>
#include <string_view>

namespace listric {

/// A word in quotes, as a POSIX shell takes it whatever it holds.
std::string shell_quoted(std::string_view word);

} // namespace listric
