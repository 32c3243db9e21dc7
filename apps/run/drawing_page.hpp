#pragma once

#include "apps/scene/scene_file.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace listric {

/// Beginning of every page for drawing, by which the program knows its own.
inline constexpr std::string_view drawing_page_begins = "<!DOCTYPE html>\n<!-- listric draw -->";

/// Picture under the drawing.
struct UnderPicture {
    std::filesystem::path file; ///< PNG or JPEG
    /// Upper left and lower right corner in the section: x, depth, m; none: set in the page.
    std::optional<std::array<double, 4>> corners;
};

/// Page in which a section is drawn, beginning with a scene: one file that asks for no other. It
/// holds the schema of scenes, for its forms, and the model, which reads, checks, predicts and runs
/// (apps/page), if this program has it. The speed of this machine with so many threads is measured,
/// in about a second, once all else is known to be good. Throws SceneError, UsageError if there is
/// no such picture, and StorageError if a file of the program's is missing.
std::string drawing_html(const std::string& scene, const std::optional<UnderPicture>& picture,
                         int threads, EffectList effects);

} // namespace listric
