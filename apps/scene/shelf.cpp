#include "apps/scene/shelf.hpp"

#include "apps/support/error.hpp"
#include "apps/support/file.hpp"
#include "apps/support/resources.hpp"
#include "apps/support/spelling.hpp"

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

toml::table Shelf::read(const fs::path& path) const {
    if (is_pipe_or_device(path))
        fail(fmt::format("{}: is no regular file (a pipe or a device); needs a {}, saved in a file",
                         path.string(), kind));
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    std::getline(file, text, '\0'); // stops early where the file is not text
    if (!file.is_open() || file.bad())
        fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    if (!file.eof())
        fail(fmt::format("{}:{}: is not a text file (it has a NUL byte); a {} is TOML in UTF-8",
                         path.string(), 1 + std::ranges::count(text, '\n'), kind));
    toml::table document = parse(text, path.string());
    if (document.empty())
        fail(fmt::format("{}: is empty; {}", path.string(), contents));
    return document;
}

} // namespace listric
