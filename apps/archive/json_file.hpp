#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

namespace listric {

/// Reads a JSON file that a call has left. Throws StorageError if it is missing or damaged.
nlohmann::json read_json(const std::filesystem::path& file);

} // namespace listric
