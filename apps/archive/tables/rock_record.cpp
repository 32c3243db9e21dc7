#include "apps/archive/tables/rock_record.hpp"

#include "apps/archive/folder/json_file.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace listric::archive {

namespace fs = std::filesystem;

nlohmann::ordered_json rocks_json(const RockOrigins& origins) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const RockOrigin& origin : origins)
        list.push_back({{"of", origin.of}, {"name", origin.name}, {"changed", origin.changed}});
    return list;
}

std::optional<RockOrigins> recorded_rocks(const fs::path& output) {
    for (const char* file : {"summary.json", "status.json"}) {
        const JsonObject json = object_in(output / file);
        const auto rocks = json.find("rocks");
        if (rocks == json.end() || !rocks->is_array())
            continue;
        try {
            RockOrigins origins;
            for (const auto& one : *rocks)
                origins.push_back({one.at("of"), one.at("name"), one.at("changed")});
            return origins;
        } catch (const nlohmann::json::exception&) {
            continue; // of another kind
        }
    }
    return std::nullopt;
}

std::optional<RockOrigins> known_rocks(const Scene& scene) {
    if (!scene.files.empty()) {
        const fs::path folder = scene.files.front().parent_path();
        std::error_code error;
        if (scene.files.front().filename() == "scene.toml" &&
            fs::is_directory(folder / "snapshots", error))
            return recorded_rocks(folder);
    }
    return rock_origins(scene);
}

} // namespace listric::archive
