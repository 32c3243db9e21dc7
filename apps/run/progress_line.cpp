#include "apps/run/progress_line.hpp"

#include "apps/support/words/spelling.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

namespace {

std::string bar(double share, std::size_t cells) {
    const auto full = static_cast<std::size_t>(share * static_cast<double>(cells));
    return fmt::format("[{}{}] ", std::string(full, '#'), std::string(cells - full, '-'));
}

/// "09:31"; of another day "Thu 09:31", of another week the date.
std::string clock_text(std::time_t then, std::time_t now) {
    constexpr double day = 86400.0;
    const double away = std::difftime(then, now);
    const std::tm end = fmt::localtime(then);
    if (end.tm_yday == fmt::localtime(now).tm_yday && away < day)
        return fmt::format("{:%H:%M}", end);
    return away < 6.0 * day ? fmt::format("{:%a %H:%M}", end) : fmt::format("{:%Y-%m-%d}", end);
}

} // namespace

std::string progress_line(const Progress& progress, std::size_t columns) {
    const double share = std::clamp(progress.share, 0.0, 1.0);
    std::string line = fmt::format("{:.0f} %  {}", std::floor(100.0 * share), progress.what);
    std::string end;
    if (progress.left) {
        line += fmt::format("  {} left", rough_duration(*progress.left));
        const auto left = static_cast<std::time_t>(std::llround(*progress.left));
        end = fmt::format(" (ends {})", clock_text(progress.now + left, progress.now));
    }
    const std::string tries[] = {bar(share, 10) + line + end, bar(share, 10) + line,
                                 bar(share, 5) + line};
    const auto fits = std::ranges::find_if(
        tries, [&](const std::string& text) { return text.size() <= columns; });
    return fits == std::end(tries) ? line : *fits;
}

} // namespace listric
