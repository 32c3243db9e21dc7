#include "apps/scene/toml/json_text.hpp"

#include <nlohmann/json.hpp>

namespace listric {

namespace {

template <class Json> std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string to_text(const nlohmann::json& json, int indent) { return text_of(json, indent); }
std::string to_text(const nlohmann::ordered_json& json, int indent) {
    return text_of(json, indent);
}

} // namespace listric
