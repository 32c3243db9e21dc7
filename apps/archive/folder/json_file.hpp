#pragma once

#include "apps/scene/toml/json_text.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// JSON that a call has left for later ones. Anybody may have changed it since, so nothing here
// trusts its shape: what is damaged or of another kind is as if it were not there.

namespace listric {

using JsonObject = nlohmann::ordered_json;

/// JSON of any shape; discarded if the text is none, or nested so deeply that nobody can have
/// meant it.
JsonObject parse_json(std::string_view text);

/// The object in a file; an empty one if there is none.
JsonObject object_in(const std::filesystem::path& file);

/// The object in a file. Throws StorageError where there is none.
JsonObject read_object(const std::filesystem::path& file);

/// Members by type. Nothing where `object` is none, or has no such member of that type.
std::string text_at(const JsonObject& object, const char* key);
std::optional<double> number_at(const JsonObject& object, const char* key);
double need_number(const JsonObject& object, const char* key); ///< throws StorageError
/// Its digits: a double holds no whole number beyond 2^53.
std::optional<std::string> whole_number_at(const JsonObject& object, const char* key);
std::vector<std::string> texts_at(const JsonObject& object, const char* key); ///< of a list
bool is_true_at(const JsonObject& object, const char* key);
JsonObject object_at(const JsonObject& object, const char* key);

/// Writes an object, indented. Throws StorageError.
void write_object(const std::filesystem::path& file, const JsonObject& object);

} // namespace listric
