#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/toml/toml.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

// A scene's document as JSON, for pages, which edit it.

namespace listric {

/// A value of a document; keys are in the order of the text. What no number of JSON holds (dates,
/// whole numbers beyond 2^53, inf, nan) is {"toml": its text}.
nlohmann::ordered_json json_of(const toml::node& node);

/// Such a document as the text of a scene: its top, then its tables, each with its purpose.
std::string toml_text(const nlohmann::ordered_json& document, EffectList effects);

} // namespace listric
