#include "apps/scene/toml/shelf.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace listric {

namespace fs = std::filesystem;

bool is_path(const std::string& name_or_path) {
    return name_or_path.find('/') != name_or_path.npos || name_or_path.ends_with(".toml");
}

fs::path Shelf::path() const {
    const char* other = std::getenv(variable);
    return other && *other ? fs::path(other) : resource_folder() / folder;
}

std::vector<std::string> Shelf::names() const {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator file(path(), error), end; !error && file != end;
         file.increment(error)) {
        if (file->path().extension() == ".toml")
            names.push_back(file->path().stem().string());
    }
    if (error)
        fail(fmt::format("{}: {}s folder cannot be read: {}", path().string(), kind,
                         error.message()));
    std::ranges::sort(names);
    return names;
}

fs::path Shelf::find(const std::string& wanted) const {
    const fs::path file = is_path(wanted) ? fs::path(wanted) : path() / (wanted + ".toml");
    std::error_code error;
    if (fs::is_directory(file, error))
        fail(fmt::format("{}: is a directory, needs a {} file", file.string(), kind));
    if (fs::exists(file, error))
        return file;
    std::error_code none;
    if (!is_path(wanted) && fs::is_regular_file(wanted, none))
        fail(fmt::format("{}: the name of a {} ends with .toml; rename the file", wanted, kind));
    const std::vector<std::string> shipped = names();
    const std::vector<std::string_view> candidates(shipped.begin(), shipped.end());
    const auto meant = nearest(is_path(wanted) ? file.stem().string() : wanted, candidates);
    fail(fmt::format("{}: {}{} ({}s: {})", wanted.empty() ? "\"\"" : wanted,
                     error             ? error.message()
                     : is_path(wanted) ? std::string("no such file")
                                       : fmt::format("no such {}", kind),
                     meant ? fmt::format(", did you mean {}?", *meant) : "", kind,
                     fmt::join(shipped, ", ")));
}

std::string Shelf::namesake(const std::string& wanted, const fs::path& beside) const {
    const fs::path other = beside / (wanted + ".toml");
    std::error_code error;
    if (is_path(wanted) || !fs::is_regular_file(other, error) ||
        fs::equivalent(other, find(wanted), error))
        return {};
    return fmt::format("{0}: is the shipped {1}; the file {0}.toml in this folder is ./{0}.toml",
                       wanted, kind);
}

namespace {

constexpr std::size_t most_bytes = 64'000'000;

/// Where a file is not text in UTF-8, and how to make it some.
std::string objection_to_bytes(const fs::path& path, std::string_view text, std::size_t place,
                               std::string_view kind) {
    const auto line = 1 + std::ranges::count(text.substr(0, place), '\n');
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        return fmt::format("{}:1: is UTF-16; a {} is TOML in UTF-8: save it so", path.string(),
                           kind);
    if (text[place] == '\0')
        return fmt::format("{}:{}: is not a text file (it has a NUL byte); a {} is TOML in UTF-8",
                           path.string(), line, kind);
    const std::size_t begin = text.substr(0, place).rfind('\n') + 1; // npos + 1 is 0
    return fmt::format("{}:{}:{}: {}; a {} is TOML in UTF-8: save it so", path.string(), line,
                       place - begin + 1, objection_to_byte(text, place), kind);
}

} // namespace

toml::table Shelf::read(const fs::path& path) const {
    if (is_pipe_or_device(path))
        fail(fmt::format("{}: is no regular file (a pipe or a device); needs a {}, saved in a file",
                         path.string(), kind));
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    // Stops early where the file is not text, or has no end.
    for (char letter = 1; letter != '\0' && text.size() <= most_bytes && file.get(letter);)
        text += letter;
    if (!file.is_open() || file.bad())
        fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    if (text.size() > most_bytes)
        fail(fmt::format("{}: is larger than {} MB; a {} is a few kB of TOML", path.string(),
                         most_bytes / 1'000'000, kind));
    if (const auto place = unsound_byte(text))
        fail(objection_to_bytes(path, text, *place, kind));
    toml::table document = parse(text, path.string());
    if (document.empty())
        fail(fmt::format("{}: is empty; {}", path.string(), contents));
    return document;
}

} // namespace listric
