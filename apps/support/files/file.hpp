#pragma once

#include "apps/support/files/reading.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace listric {

/// Writes bytes to a temporary name, to the disk, and renames. The file of the final name is
/// complete or the old one, whenever the program or the machine stops. Throws StorageError.
void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Writes a text as write_bytes() does.
void write_text(const std::filesystem::path& path, std::string_view text);

/// Makes a folder and those above it, if they are not there. Throws StorageError.
void make_folder(const std::filesystem::path& folder);

/// A folder that is removed with what is in it.
struct TemporaryFolder {
    /// Makes a hidden one in `where`. Throws StorageError.
    explicit TemporaryFolder(const std::filesystem::path& where);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path path;
};

} // namespace listric
