#pragma once

#include <filesystem>
#include <string>

namespace listric {

/// A picture as it lies in its file.
struct Png {
    std::string bytes;
    int width = 0, height = 0; ///< pixels
};

/// Pixels that a picture may have: more are no section, and no program could show them.
inline constexpr double most_pixels = 1e8;

/// Reads a picture and makes sure that it is whole: its signature, its size, the checksum of every
/// chunk, as many bytes as its pixels need (PNG, second edition, ISO 15948). Throws
/// UsageError, which names the file, what it is, and a cure.
Png read_png(const std::filesystem::path& file);

} // namespace listric
