#pragma once

#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace listric::archive {

/// Hash of every parameter in force: of scene.toml without its comments.
std::uint64_t scene_hash(const std::string& parameters);
std::uint64_t scene_hash(const Scene& scene);

/// Origin of a result of this program and a scene: version, commit if it is known, compiler,
/// instruction_set, scene_hash, seed. Neither time nor machine: equal for equal programs and
/// scenes.
nlohmann::ordered_json provenance(const std::string& parameters, std::uint64_t seed);
nlohmann::ordered_json provenance(const Scene& scene);

/// Origin of a run, with the versions that made a part of it.
nlohmann::ordered_json provenance(const Scene& scene, const RunRecord& record);

/// Origin of a run, from its summary; where that lacks it, from its scene alone.
nlohmann::ordered_json provenance_of_run(const std::filesystem::path& output, const Scene& scene);

/// Whether a summary is of the scene beside it, not one that was copied there or that somebody has
/// changed since. Where a summary does not say, and where a version that went on with another's run
/// may write its scene otherwise, it counts as that.
/// @param scene  text of scene.toml
bool is_of_scene(const nlohmann::ordered_json& summary, const std::string& scene);

/// Versions of the program that made a finished run, that which finished it last: "A, B".
std::string makers_of(const std::filesystem::path& output);
std::string makers_of(const nlohmann::ordered_json& summary);

} // namespace listric::archive
