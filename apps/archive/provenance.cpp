#include "apps/archive/provenance.hpp"

#include "apps/archive/json_file.hpp"
#include "apps/archive/scene_lines.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/version.hpp"
#include "dem/hash.hpp"

#include <fmt/format.h>

#include <string>

namespace listric::archive {

namespace {

using Json = nlohmann::ordered_json;

void add_scene(Json& json, const Scene& scene) {
    json["scene_hash"] = fmt::format("{:016x}", scene_hash(scene));
    json["seed"] = scene.seed;
}

} // namespace

std::uint64_t scene_hash(const Scene& scene) {
    std::uint64_t hash = dem::fnv1a_start;
    for (const std::string& line : scene_lines(to_toml(scene))) {
        hash = dem::fnv1a(line, hash);
        hash = dem::fnv1a("\n", hash);
    }
    return hash;
}

Json provenance(const Scene& scene) {
    const std::size_t plus = version.find('+');
    Json json = {{"version", version.substr(0, plus)}};
    if (plus != version.npos)
        json["commit"] = version.substr(plus + 1);
    json["compiler"] = compiler;
    json["instruction_set"] = instruction_set;
    add_scene(json, scene);
    return json;
}

Json provenance_of_run(const std::filesystem::path& output, const Scene& scene) {
    Json json = object_at(object_in(output / "summary.json"), "provenance");
    if (!json.empty())
        return json;
    add_scene(json, scene);
    return json;
}

} // namespace listric::archive
