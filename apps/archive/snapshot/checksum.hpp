#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace listric::archive {

/// Ends a file's bytes with a mark and a sum of all bytes before it.
void append_checksum(std::vector<std::byte>& bytes);

/// Whether a file ends with its own checksum; false if it has none. Throws StorageError if it has
/// one that is not its own, or cannot be read.
bool verify_checksum(const std::filesystem::path& path);

} // namespace listric::archive
