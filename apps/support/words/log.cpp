#include "apps/support/words/log.hpp"

#include "apps/support/stopwatch.hpp"
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
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

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

/// A closed or full stderr must not end a run.
void tell(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

} // namespace

void warn(std::string_view message) {
    tell(fmt::format("listric: warning: {}\n", shown_lines(message)));
}

struct Log::Parts {
    std::mutex mutex;
    std::ofstream file;
    std::string whose; ///< the file's folder, before a warning
    bool quiet, terminal;
    bool shows_progress = false; ///< on the terminal's current line
    bool has_progressed = false;
    SteadyClock::time_point last_progress; ///< that was shown
    SteadyClock::time_point begun = SteadyClock::now();
    std::vector<std::string> warnings;
};

Log::Log(const std::filesystem::path& file, bool quiet) : parts_(std::make_unique<Parts>()) {
    parts_->quiet = quiet;
    parts_->terminal = rewrites_lines();
    std::error_code error;
    const auto status = std::filesystem::symlink_status(file, error);
    // A link may lead to a file of somebody's, and a pipe may wait for ever.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        warn(fmt::format("{}: is no plain file; nothing is logged there", shown(file.string())));
    else if (!file.empty())
        parts_->file.open(file, std::ios::app);
    if (!file.empty())
        parts_->whose = shown(file.parent_path().string()) + ": ";
}

Log::~Log() {
    if (parts_->shows_progress)
        tell(clear_line);
}

void Log::say(std::string_view text) {
    const std::lock_guard lock(parts_->mutex);
    const std::string message = shown_lines(text);
    if (message.starts_with(warning_mark))
        parts_->warnings.push_back(message);
    if (parts_->file.is_open())
        parts_->file << fmt::format("{:%Y-%m-%d %H:%M:%S}  {}", fmt::localtime(std::time(nullptr)),
                                    message)
                     << std::endl;
    if (!parts_->quiet)
        tell(fmt::format("{}{}\n", parts_->terminal ? clear_line : "", message));
    else if (message.starts_with(warning_mark))
        tell(fmt::format("{}listric: {}{}{}\n", parts_->terminal ? clear_line : "", warning_mark,
                         parts_->whose, message.substr(warning_mark.size())));
    parts_->shows_progress = false;
}

void Log::progress(std::string_view line) {
    progress([&](std::size_t) { return std::string(line); });
}

void Log::progress(const std::function<std::string(std::size_t columns)>& line) {
    const std::lock_guard lock(parts_->mutex);
    const double pause = // s
        parts_->terminal ? 0.2 : std::clamp(0.05 * seconds_since(parts_->begun), 10.0, 600.0);
    if (parts_->quiet || (parts_->has_progressed && seconds_since(parts_->last_progress) < pause))
        return;
    parts_->has_progressed = true;
    parts_->last_progress = SteadyClock::now();
    if (parts_->terminal) { // the last column stays free: some wrap a line that ends in it
        const std::size_t columns = terminal_columns() - 1;
        tell(fmt::format("{}{}", clear_line, cut_to(shown(line(columns)), columns)));
    } else {
        tell(shown(line(std::string::npos)) + "\n");
    }
    parts_->shows_progress = parts_->terminal;
}

void Log::repeat_warnings() {
    std::vector<std::string> warnings;
    {
        const std::lock_guard lock(parts_->mutex);
        warnings.swap(parts_->warnings);
    }
    if (!warnings.empty())
        say(fmt::format("there {}:", warnings.size() == 1
                                         ? "was a warning"
                                         : fmt::format("were {} warnings", warnings.size())));
    for (const std::string& warning : warnings)
        say("  " + warning);
}

} // namespace listric
