#include "apps/support/machine/shell.hpp"

namespace listric {

std::string shell_quoted(std::string_view word) {
    std::string result = "'";
    for (const char letter : word)
        result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return result + "'";
}

} // namespace listric
