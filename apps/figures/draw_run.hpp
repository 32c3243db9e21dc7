#pragma once

#include "apps/archive/run_folder.hpp"
#include "apps/archive/run_history.hpp"
#include "apps/figures/frame.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Draws the figures of all snapshots of a run's folder at the scene's figure extensions and of
/// the newest one. Throws UsageError if there is nothing to draw, SceneError, StorageError.
/// @param underlay  that sections are drawn over, if there is one
/// @param formats  of picture_formats
/// @param extensions  of the snapshots, m, whose sections alone are drawn; none: the scene's
/// @param wells  x, m, of wells whose figure alone is drawn; none: where the effect has them
void draw_run(const std::filesystem::path& output, const std::optional<Underlay>& underlay,
              const std::vector<std::string>& formats, const std::vector<double>& extensions,
              const std::vector<double>& wells = {});

/// Draws the same moments on one sheet, if there are at least two. Throws as draw_run.
/// @param history  the run's past, up to its end
void draw_experiment(const archive::RunFolder& run, const archive::RunHistory& history);

/// Draws every snapshot of a run's folder as a frame of an animation: MP4 with ffmpeg, else GIF.
/// Throws as draw_run.
void animate_run(const std::filesystem::path& output);

} // namespace listric
