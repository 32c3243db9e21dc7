#pragma once

#include "apps/support/machine/stop.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace listric {

/// A state on a picture of many runs.
struct PicturedState {
    std::filesystem::path run;     ///< folder
    std::string caption;           ///< beside it
    std::optional<double> at = {}; ///< extension of the nearest snapshot, m; none: the last one
};

/// Draws states below each other into a PNG file.
/// @param kind  "gallery" or "multiples", see FigureFrames
/// Throws StorageError, Interrupted, and what cannot be drawn.
void draw_states(std::span<const PicturedState> states, const std::string& kind,
                 const std::filesystem::path& file, StopToken stop);

} // namespace listric
