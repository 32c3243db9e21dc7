#include "apps/laboratory/request.hpp"

#include "apps/archive/folder/scene_lines.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace listric {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_difference(const fs::path& output, const std::string& what,
                                    const std::string& before, const std::string& now) {
    const auto [there, here] = shown_apart(before, now);
    throw UsageError(fmt::format("{}: holds the results of another call: {} = {} there, {} here; "
                                 "--output writes elsewhere",
                                 output.string(), shown(what), there, here));
}

} // namespace

std::string summary_version() { return std::string(version); }

void require_same_request(const fs::path& output, const JsonObject& asked) {
    const fs::path file = output / "summary.json";
    std::error_code error;
    if (!fs::exists(file, error))
        return;
    const JsonObject summary = object_in(file), before = object_at(summary, "request");
    for (const auto& [key, value] : before.items())
        if (asked.contains(key) && asked[key] != value)
            refuse_difference(output, key, to_text(value), to_text(asked[key]));
    if (summary.empty())
        warn(fmt::format("{}: is damaged: the results are made again", file.string()));
    else if (before.empty())
        warn(fmt::format("{}: of which call it is, is not recorded: the results are made again",
                         file.string()));
    else if (text_at(summary, "version") != version)
        warn(fmt::format("{}: listric {} has made it, and this is {}: the results are made again",
                         file.string(), text_at(summary, "version"), version));
}

void require_same_material(const fs::path& file, const std::string& asked) {
    const auto before = archive::scene_values(read_text_if_there(file));
    const auto now = archive::scene_values(asked);
    for (const auto& [key, value] : before)
        if (const auto found = now.find(key); found == now.end() || found->second != value)
            refuse_difference(file.parent_path(), key, value,
                              found == now.end() ? "nothing" : found->second);
}

} // namespace listric
