#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/toml/toml.hpp"

#include <filesystem>
#include <string>

namespace listric {

/// The value at a path of keys, or else its table, or else the document.
Entry entry_at(const toml::table& document, const std::string& path);

/// Why pieces are no detachment; empty: they are.
std::string objection_to_pieces(const dem::DetachmentParameters& detachment);

/// Results go into a folder of the scene's name, so it must be one. Throws SceneError.
void check_name(const Heading& heading, const toml::table& document,
                const std::filesystem::path& file);

/// Checks of tables against each other, which no single parameter can fail. Throws SceneError.
void check_scene(const Scene& scene, const toml::table& document, EffectList effects);

/// Takes out keys that effects had once and whose value is what is done now. Throws SceneError of
/// others.
void take_out_former_keys(toml::table& document, EffectList effects);

} // namespace listric
