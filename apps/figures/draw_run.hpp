#pragma once

#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/run_history.hpp"
#include "apps/figures/frame.hpp"
#include "apps/figures/picture_order.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Request of a call of `listric figures`.
struct FiguresRequest {
    std::filesystem::path output;          ///< the run's folder
    std::optional<Underlay> underlay = {}; ///< that sections are drawn over
    std::vector<double> extensions = {};   ///< of the snapshots, m, whose sections alone are drawn;
                                           ///< none: the scene's
    std::vector<double> wells = {};        ///< x, m, of wells whose figure alone is drawn; none:
                                           ///< where the effect has them
    PictureOrder order = {};               ///< all but the provenance
    std::filesystem::path pictures = {};   ///< folder of the files; empty: figures of the run's
};

/// Draws the figures of all snapshots of a run's folder at the scene's figure extensions and of
/// the newest one. Returns the files. Throws UsageError if there is nothing to draw, or no such
/// panel, SceneError, StorageError.
std::vector<std::filesystem::path> draw_run(const FiguresRequest& request);

/// Draws the same moments on one sheet, if there are at least two. Throws as draw_run.
/// @param history  the run's past, up to its end
void draw_experiment(const archive::RunFolder& run, const archive::RunHistory& history);

/// Draws every snapshot of a run's folder as a frame of an animation. Returns the file. Throws as
/// draw_run.
/// @param formats  of film_formats; none: MP4 with ffmpeg, else GIF
/// @param pictures  folder of the film; empty: figures of the run's
std::vector<std::filesystem::path> animate_run(const std::filesystem::path& output,
                                               const std::vector<std::string>& formats = {},
                                               const std::filesystem::path& pictures = {});

} // namespace listric
