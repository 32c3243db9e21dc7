#pragma once

#include "apps/scene/scene_request.hpp"
#include "apps/scene/toml/shelf.hpp"
#include "apps/scene/toml/toml.hpp"

#include <filesystem>

// Files as tables of TOML, for those who read tables; others see neither.

namespace listric {

/// The table in a file of a shelf's kind. Throws SceneError.
toml::table read_document(const Shelf& shelf, const std::filesystem::path& file);

/// The table in a scene's file, with a call's changes. Throws SceneError.
toml::table merged_document(const SceneRequest& request, const std::filesystem::path& file);

} // namespace listric
