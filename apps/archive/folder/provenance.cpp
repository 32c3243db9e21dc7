#include "apps/archive/folder/provenance.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/version.hpp"
#include "dem/numbers/hash.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace listric::archive {

namespace {

using Json = nlohmann::ordered_json;

void add_scene(Json& json, const std::string& parameters, std::uint64_t seed) {
    json["scene_hash"] = fmt::format("{:016x}", scene_hash(parameters));
    json["seed"] = seed;
}

} // namespace

std::uint64_t scene_hash(const std::string& parameters) {
    std::uint64_t hash = dem::fnv1a_start;
    for (const std::string& line : scene_lines(parameters)) {
        hash = dem::fnv1a(line, hash);
        hash = dem::fnv1a("\n", hash);
    }
    return hash;
}

std::uint64_t scene_hash(const Scene& scene) { return scene_hash(to_toml(scene)); }

Json provenance(const std::string& parameters, std::uint64_t seed) {
    const std::size_t plus = version.find('+');
    Json json = {{"version", version.substr(0, plus)}};
    if (plus != version.npos)
        json["commit"] = version.substr(plus + 1);
    json["compiler"] = compiler;
    json["instruction_set"] = instruction_set;
    add_scene(json, parameters, seed);
    return json;
}

Json provenance(const Scene& scene) { return provenance(to_toml(scene), scene.seed); }

Json provenance(const Scene& scene, const RunRecord& record) {
    Json json = provenance(record.scene, scene.seed); // of scene.toml
    if (!record.earlier_versions.empty())
        json["earlier_versions"] = record.earlier_versions;
    return json;
}

Json provenance_of_run(const std::filesystem::path& output, const Scene& scene) {
    Json json = object_at(object_in(output / "summary.json"), "provenance");
    if (!json.empty())
        return json;
    add_scene(json, to_toml(scene), scene.seed);
    return json;
}

bool is_of_scene(const Json& summary, const std::string& scene) {
    const Json made = object_at(summary, "provenance");
    const std::string hash = text_at(made, "scene_hash");
    return hash.empty() || scene.empty() || !texts_at(made, "earlier_versions").empty() ||
           hash == fmt::format("{:016x}", scene_hash(scene));
}

std::string makers_of(const std::filesystem::path& output) {
    return makers_of(object_in(output / "summary.json"));
}

std::string makers_of(const Json& summary) {
    const Json made = object_at(summary, "provenance");
    std::vector<std::string> makers = texts_at(made, "earlier_versions");
    const std::string commit = text_at(made, "commit");
    makers.push_back(text_at(made, "version") + (commit.empty() ? "" : "+" + commit));
    return fmt::format("{}", fmt::join(makers, ", "));
}

} // namespace listric::archive
