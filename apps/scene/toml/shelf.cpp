#include "apps/scene/toml/shelf.hpp"

#include "apps/scene/toml/toml.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/reading.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

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
    for (const fs::path& file : list_folder(path(), error))
        if (file.extension() == ".toml")
            names.push_back(file.stem().string());
    if (error)
        fail(fmt::format("{}: {}s folder cannot be read: {}", path().string(), kind,
                         error.message()));
    std::ranges::sort(names);
    return names;
}

fs::path Shelf::find(const std::string& wanted) const {
    const fs::path file = is_path(wanted) ? fs::path(wanted) : path() / (wanted + ".toml");
    std::error_code error;
    const fs::file_status status = status_of(file, error);
    if (fs::is_directory(status))
        fail(fmt::format("{}: is a directory, needs a {} file", file.string(), kind));
    if (fs::exists(status))
        return file;
    if (fs::status_known(status)) // that it is not there
        error.clear();
    if (!is_path(wanted) && is_file(wanted))
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
    if (is_path(wanted) || !is_file(other) || fs::equivalent(other, find(wanted), error))
        return {};
    return fmt::format("{0}: is the shipped {1}; the file {0}.toml in this folder is ./{0}.toml",
                       wanted, kind);
}

} // namespace listric
