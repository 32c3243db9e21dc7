#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace listric {

/// "listric: warning: ..." on stderr, for work without a log.
void warn(std::string_view message);

/// Messages to people while something runs: messages, which stay, and progress, which does not.
/// Both go to stderr, or warnings alone if it shall be quiet, then with the folder that they
/// concern; messages, with their time, also into a file, if there is one. On a terminal the line of
/// progress is rewritten; elsewhere it appears as plain lines, a few per minute at most, and the
/// fewer the longer the work takes. Threads may share one.
class Log {
public:
    /// Without a file.
    explicit Log(bool quiet) : Log({}, quiet) {}

    /// Appends to a file. One that cannot be written is no error: nobody needs to listen.
    Log(const std::filesystem::path& file, bool quiet);

    /// Removes what is left of the progress.
    ~Log();
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    void say(std::string_view message);
    void progress(std::string_view line);

    /// A line that depends on the columns that it may take; made only where it is shown.
    void progress(const std::function<std::string(std::size_t columns)>& line);

    /// Says the warnings of before once more, if there were any.
    void repeat_warnings();

private:
    struct Parts; // few of those who include this see files, threads and clocks
    std::unique_ptr<Parts> parts_;
};

/// Columns for people: as COLUMNS has them, else of the terminal that standard error or output is
/// now, for a window may have been resized; else 80.
std::size_t terminal_columns();

} // namespace listric
