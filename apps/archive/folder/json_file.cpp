#include "apps/archive/folder/json_file.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace listric {

namespace {

constexpr int deepest = 64; // ours are nested five deep; freeing what is deeper may recurse

/// Whether brackets that are not within strings are nested more deeply than ours ever are.
bool is_too_deep(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char letter = text[k];
        if (letter == '"')
            quoted = !quoted;
        else if (quoted && letter == '\\')
            ++k;
        else if (!quoted && (letter == '[' || letter == '{') && ++depth > deepest)
            return true;
        else if (!quoted && (letter == ']' || letter == '}'))
            --depth;
    }
    return false;
}

/// The member of a key; none if there is no such one, or no object.
const JsonObject* member(const JsonObject& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? &*found : nullptr;
}

} // namespace

JsonObject parse_json(std::string_view text) {
    return is_too_deep(text) ? JsonObject(JsonObject::value_t::discarded)
                             : JsonObject::parse(text, nullptr, false);
}

JsonObject object_in(const std::filesystem::path& file) {
    JsonObject json = parse_json(read_text_if_there(file));
    return json.is_object() ? json : JsonObject::object();
}

JsonObject read_object(const std::filesystem::path& file) {
    JsonObject json = parse_json(read_text(file));
    if (!json.is_object())
        throw StorageError(file.string() + ": is damaged (no JSON object)");
    return json;
}

std::string text_at(const JsonObject& object, const char* key) {
    const JsonObject* const found = member(object, key);
    return found && found->is_string() ? found->get<std::string>() : "";
}

std::optional<double> number_at(const JsonObject& object, const char* key) {
    const JsonObject* const found = member(object, key);
    if (!found || !found->is_number() || !std::isfinite(found->get<double>()))
        return std::nullopt;
    return found->get<double>();
}

std::optional<std::string> whole_number_at(const JsonObject& object, const char* key) {
    const JsonObject* const found = member(object, key);
    return found && found->is_number_integer() ? std::optional(to_text(*found)) : std::nullopt;
}

std::vector<std::string> texts_at(const JsonObject& object, const char* key) {
    std::vector<std::string> texts;
    if (const JsonObject* const found = member(object, key); found && found->is_array())
        for (const JsonObject& one : *found)
            if (one.is_string())
                texts.push_back(one.get<std::string>());
    return texts;
}

double need_number(const JsonObject& object, const char* key) {
    if (const auto number = number_at(object, key))
        return *number;
    throw StorageError(std::string("the summary of a run lacks the number ") + key);
}

bool is_true_at(const JsonObject& object, const char* key) {
    const JsonObject* const found = member(object, key);
    return found && found->is_boolean() && found->get<bool>();
}

JsonObject object_at(const JsonObject& object, const char* key) {
    const JsonObject* const found = member(object, key);
    return found && found->is_object() ? *found : JsonObject::object();
}

void write_object(const std::filesystem::path& file, const JsonObject& object) {
    write_text(file, to_text(object, 2) + "\n");
}

} // namespace listric
