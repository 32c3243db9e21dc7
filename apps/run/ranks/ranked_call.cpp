#include "apps/run/ranks/ranked_call.hpp"

#include "apps/archive/folder/scene_lines.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// Parameters of scene.toml's text, by table.
void add_scene(std::vector<CallPart>& call, const Scene& scene) {
    const std::string what = "was called with another scene";
    std::string table;
    for (const std::string& line : archive::scene_lines(to_toml(scene))) {
        const std::size_t equals = line.find(" = ");
        if (line.starts_with('[')) {
            table = line.substr(1, line.find(']') - 1);
            call.push_back({what, fmt::format("[{}]", table), ""});
        } else if (equals != line.npos) {
            call.push_back({what, (table.empty() ? "" : table + ".") + line.substr(0, equals),
                            line.substr(equals + 3)});
        }
    }
}

/// Where the results go. Machines may see one folder by different paths.
std::string place_of(const fs::path& output) {
    char machine[256] = "";
    gethostname(machine, sizeof machine - 1);
    std::error_code error;
    return fmt::format("{} on {}", fs::weakly_canonical(fs::absolute(output), error).string(),
                       machine);
}

/// A value as a message has room for it, from a little before where it differs from another.
std::string excerpt(std::string_view value, std::string_view other) {
    constexpr std::size_t before = 12, most = 60;
    const auto same =
        static_cast<std::size_t>(std::ranges::mismatch(value, other).in1 - value.begin());
    if (value.size() <= most)
        return shown(value);
    const std::size_t begin = same > before + 10 ? same - before : 0;
    return fmt::format("{}{}{}", begin > 0 ? "..." : "", shown(value.substr(begin, most)),
                       value.size() - begin > most ? "..." : "");
}

bool is_same(const CallPart& root, const CallPart& there) {
    if (root.of != there.of || root.name != there.name)
        return false;
    if (root.value == there.value || root.name != "--output")
        return root.value == there.value;
    // "PATH on MACHINE"
    const auto machine = [](const std::string& place) { return place.substr(place.rfind(' ')); };
    return machine(root.value) != machine(there.value);
}

std::string value_in(const std::vector<CallPart>& call, const CallPart& part) {
    const auto found = std::ranges::find_if(call, [&](const CallPart& other) {
        return other.of == part.of && other.name == part.name;
    });
    return found == call.end() ? "none" : found->value;
}

} // namespace

std::vector<CallPart> call_of(const Scene& scene, const RunOptions& options) {
    std::vector<CallPart> call{{"is another program", "version", std::string(version)},
                               {"is another program", "sources of dem", std::string(source_hash)}};
    add_scene(call, scene);
    call.push_back({"was called with another target", "--until",
                    fmt::format("{}m", options.end(scene.extension.distance))});
    call.push_back({"was called with another output", "--output", place_of(options.output)});
    const auto yes_or_no = [](bool given) { return given ? "yes" : "no"; };
    call.push_back({"was called otherwise", "--resume", yes_or_no(options.resume)});
    call.push_back({"was called otherwise", "--force", yes_or_no(options.force)});
    return call;
}

std::optional<std::string> first_difference(const std::vector<CallPart>& root,
                                            const std::vector<CallPart>& there) {
    const auto [a, b] = std::ranges::mismatch(root, there, is_same);
    if (a == root.end() && b == there.end())
        return std::nullopt;
    // A difference of only one of them stands where the other goes on.
    const bool is_only_there =
        a == root.end() ||
        (b != there.end() && value_in(root, *b) == "none" && value_in(there, *a) != "none");
    const CallPart& part = is_only_there ? *b : *a;
    if (part.value.empty()) // a table
        return fmt::format("{}: {} {}", part.of, shown(part.name),
                           is_only_there ? "there, none here" : "here, none there");
    const std::string value_here = value_in(root, part), value_there = value_in(there, part);
    return fmt::format("{}: {} {} there, {} here", part.of, shown(part.name),
                       excerpt(value_there, value_here), excerpt(value_here, value_there));
}

dem::Bytes packed(const std::vector<CallPart>& call) {
    dem::Bytes letter;
    for (const CallPart& part : call)
        for (const std::string* text : {&part.of, &part.name, &part.value}) {
            const auto bytes = std::as_bytes(std::span(text->c_str(), text->size() + 1));
            letter.insert(letter.end(), bytes.begin(), bytes.end());
        }
    return letter;
}

std::vector<CallPart> unpacked_call(const dem::Bytes& letter) {
    std::vector<std::string> texts(1);
    for (const std::byte byte : letter) {
        if (byte == std::byte{})
            texts.emplace_back();
        else
            texts.back() += static_cast<char>(byte);
    }
    std::vector<CallPart> call;
    for (std::size_t k = 0; k + 3 <= texts.size() - 1; k += 3)
        call.push_back({std::move(texts[k]), std::move(texts[k + 1]), std::move(texts[k + 2])});
    return call;
}

} // namespace listric
