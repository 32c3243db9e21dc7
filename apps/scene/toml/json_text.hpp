#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace listric {

/// JSON as text. Bytes that are no UTF-8 become U+FFFD, numbers that are not finite null: what
/// somebody wrote must not end the run that repeats it.
/// @param indent  blanks per level; -1: all in one line
std::string to_text(const nlohmann::json& json, int indent = -1);
std::string to_text(const nlohmann::ordered_json& json, int indent = -1);

} // namespace listric
