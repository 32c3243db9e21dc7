#include "apps/scene/toml/document.hpp"

#include "apps/support/files/reading.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

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

toml::table read_document(const Shelf& shelf, const fs::path& path) {
    if (is_pipe_or_device(path))
        fail(fmt::format("{}: is no regular file (a pipe or a device); needs a {}, saved in a file",
                         path.string(), shelf.kind));
    std::optional<std::string> bytes = first_bytes(path, most_bytes + 1);
    if (!bytes)
        fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    std::string text = std::move(*bytes);
    if (const auto nul = std::ranges::find(text, '\0'); nul != text.end())
        text.erase(nul + 1, text.end()); // no text, however long
    if (text.size() > most_bytes)
        fail(fmt::format("{}: is larger than {} MB; a {} is a few kB of TOML", path.string(),
                         most_bytes / 1'000'000, shelf.kind));
    if (const auto place = unsound_byte(text))
        fail(objection_to_bytes(path, text, *place, shelf.kind));
    toml::table document = parse(text, path.string());
    if (document.empty())
        fail(fmt::format("{}: is empty; {}", path.string(), shelf.contents));
    return document;
}

toml::table merged_document(const SceneRequest& request, const fs::path& path) {
    toml::table document = read_document(scenes, path);
    for (const std::string& assignment : request.set)
        set(document, assignment, "--set " + assignment);
    if (request.accuracy)
        set(document, "accuracy=" + quoted(*request.accuracy), "--accuracy " + *request.accuracy);
    if (request.seed) {
        const std::string seed = std::to_string(*request.seed);
        set(document, "seed=" + seed, "--seed " + seed);
    }
    return document;
}

} // namespace listric
