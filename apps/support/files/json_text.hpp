#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace listric {

/// JSON as text. Bytes that are no UTF-8 become U+FFFD, numbers that are not finite null: what
/// somebody wrote must not end the run that repeats it.
/// @param indent  blanks per level; -1: all in one line
template <class Json> std::string to_text(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace listric
