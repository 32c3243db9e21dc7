#include "apps/support/words/terminal.hpp"

#include "apps/support/words/number.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sys/ioctl.h>
#include <unistd.h>

namespace listric {

std::size_t terminal_columns() {
    constexpr double most = 1e6;
    const char* wanted = std::getenv("COLUMNS");
    if (const auto columns = wanted ? parse_number(wanted) : std::nullopt; columns && *columns >= 1)
        return static_cast<std::size_t>(std::min(*columns, most));
    winsize size{};
    for (const int stream : {STDERR_FILENO, STDOUT_FILENO})
        if (ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
            return size.ws_col;
    return 80;
}

} // namespace listric
