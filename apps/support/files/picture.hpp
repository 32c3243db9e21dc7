#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace listric {

/// A picture as it lies in its file.
struct Picture {
    std::string bytes;
    std::string_view type;     ///< "png" or "jpeg", as in image/png
    int width = 0, height = 0; ///< pixels
};

/// Pixels that a picture may have: more are no section, and no program could show them.
inline constexpr double most_pixels = 1e8;

/// Reads a PNG or JPEG, whatever its name ends with: signature, size and whether its end is there
/// (PNG, second edition, ISO 15948; JPEG, ITU-T T.81, annex B). Whoever draws it finds what is
/// damaged between. Throws UsageError, which names the file, what it is, and a cure.
Picture read_picture(const std::filesystem::path& file);

} // namespace listric
