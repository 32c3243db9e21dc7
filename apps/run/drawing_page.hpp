#pragma once

#include "apps/run/prediction.hpp"
#include "apps/scene/scene_file.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Beginning of every page for drawing, by which the program knows its own.
inline constexpr std::string_view drawing_page_begins = "<!DOCTYPE html>\n<!-- listric draw -->";

/// Picture under the drawing.
struct UnderPicture {
    std::filesystem::path file; ///< PNG or JPEG
    /// Upper left and lower right corner in the section: x, depth, m; none: set in the page.
    std::optional<std::array<double, 4>> corners;
};

/// Speeds of the bare cycle on this machine.
struct MachineSpeeds {
    struct AtSize {
        double discs = 0.0;
        CycleSpeed speed;
    };
    std::vector<AtSize> by_size; ///< ascending
    CycleSpeed accounted;        ///< where the energy is accounted for
    int threads = 1;
};

/// Measures speeds of four packings from 2,048 to 131,072 discs, in about a second.
MachineSpeeds measure_speeds(int threads);

/// Page in which a section is drawn, beginning with a scene: one file that asks for no other. It
/// holds the schema of scenes, rocks and prices as the program has them, so that its forms and
/// predictions are the program's. Throws SceneError, UsageError if there is no such picture, and
/// StorageError if a file of the program's is missing.
std::string drawing_html(const std::string& scene, const std::optional<UnderPicture>& picture,
                         const MachineSpeeds& speeds, EffectList effects);

} // namespace listric
