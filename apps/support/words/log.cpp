#include "apps/support/words/log.hpp"

#include "apps/support/words/number.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>
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

namespace {

constexpr std::string_view clear_line = "\r\x1b[K";
constexpr std::string_view warning_mark = "warning: "; ///< with which a message begins

/// Whether standard error is a terminal that obeys "\r" and escape sequences.
bool rewrites_lines() {
    const char* kind = std::getenv("TERM");
    return isatty(STDERR_FILENO) != 0 && kind && *kind && std::string_view(kind) != "dumb";
}

} // namespace

std::string rough_duration(double seconds) {
    const auto s = std::lround(std::min(seconds, 1e9));
    if (s < 90)
        return fmt::format("{} s", s);
    if (s < 570) {
        const auto tens = (s + 5) / 10;
        return tens % 6 == 0 ? fmt::format("{} min", tens / 6)
                             : fmt::format("{} min {} s", tens / 6, 10 * (tens % 6));
    }
    if (s < 5400)
        return fmt::format("{} min", (s + 30) / 60);
    return fmt::format("{:.1f} h", static_cast<double>(s) / 3600.0);
}

void warn(std::string_view message) {
    const std::string text = fmt::format("listric: warning: {}\n", shown_lines(message));
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

Log::Log(const std::filesystem::path& file, bool quiet)
    : quiet_(quiet), terminal_(rewrites_lines()) {
    std::error_code error;
    const auto status = std::filesystem::symlink_status(file, error);
    // A link may lead to a file of somebody's, and a pipe may wait for ever.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        warn(fmt::format("{}: is no plain file; nothing is logged there", shown(file.string())));
    else if (!file.empty())
        file_.open(file, std::ios::app);
    if (!file.empty())
        whose_ = shown(file.parent_path().string()) + ": ";
}

Log::~Log() {
    if (shows_progress_)
        tell(clear_line);
}

void Log::say(std::string_view text) {
    const std::lock_guard lock(mutex_);
    const std::string message = shown_lines(text);
    if (message.starts_with(warning_mark))
        warnings_.push_back(message);
    if (file_.is_open())
        file_ << fmt::format("{:%Y-%m-%d %H:%M:%S}  {}", fmt::localtime(std::time(nullptr)),
                             message)
              << std::endl;
    if (!quiet_)
        tell(fmt::format("{}{}\n", terminal_ ? clear_line : "", message));
    else if (message.starts_with(warning_mark))
        tell(fmt::format("{}listric: {}{}{}\n", terminal_ ? clear_line : "", warning_mark, whose_,
                         message.substr(warning_mark.size())));
    shows_progress_ = false;
}

void Log::progress(std::string_view line) {
    progress([&](std::size_t) { return std::string(line); });
}

void Log::progress(const std::function<std::string(std::size_t columns)>& line) {
    const std::lock_guard lock(mutex_);
    const double pause = // s
        terminal_ ? 0.2 : std::clamp(0.05 * seconds_since(begun_), 10.0, 600.0);
    if (quiet_ || (has_progressed_ && seconds_since(last_progress_) < pause))
        return;
    has_progressed_ = true;
    last_progress_ = SteadyClock::now();
    if (terminal_) { // the last column stays free: some wrap a line that ends in it
        const std::size_t columns = terminal_columns() - 1;
        tell(fmt::format("{}{}", clear_line, cut_to(shown(line(columns)), columns)));
    } else {
        tell(shown(line(std::string::npos)) + "\n");
    }
    shows_progress_ = terminal_;
}

void Log::repeat_warnings() {
    std::vector<std::string> warnings;
    {
        const std::lock_guard lock(mutex_);
        warnings.swap(warnings_);
    }
    if (!warnings.empty())
        say(fmt::format("there {}:", warnings.size() == 1
                                         ? "was a warning"
                                         : fmt::format("were {} warnings", warnings.size())));
    for (const std::string& warning : warnings)
        say("  " + warning);
}

/// A closed or full stderr must not end a run.
void Log::tell(std::string_view text) const {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

} // namespace listric
