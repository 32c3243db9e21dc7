#pragma once

#include "apps/figures/frame.hpp"
#include "apps/figures/picture_order.hpp"
#include "apps/measures/faults/fault.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/support/files/file.hpp"

#include <filesystem>
#include <future>
#include <optional>
#include <string>

namespace listric {

/// Draws the pictures of one state into `folder`. The state is read at once; the drawing goes on
/// beside what follows. Gives an empty string, or why it could not: pictures are worth a warning,
/// not the run.
std::future<std::string> draw_figures(const Observation& now, const measures::FaultReport& faults,
                                      const std::filesystem::path& folder,
                                      const MomentNames& names);

/// Pictures of several moments of a run: the arrays that the drawing script reads, in a folder that
/// vanishes with this object.
class FigureFrames {
public:
    /// @param folder  where the pictures go
    /// @param underlay  that sections are drawn over, if there is one
    /// @param names  of the run's moments; none: all are ends of windows
    explicit FigureFrames(const std::filesystem::path& folder,
                          std::optional<Underlay> underlay = std::nullopt, PictureOrder order = {},
                          std::optional<MomentNames> names = std::nullopt);

    /// Throws StorageError.
    void add(const Observation& now, const measures::FaultReport& faults);

    /// @param kind  "sections" of every frame, one "experiment" sheet, an "animation" or
    ///              a "gallery", gallery.png, or "multiples", multiples.png; the latter three
    ///              in their own format
    /// Throws what run_drawing_script() throws if it cannot be drawn.
    void draw(const std::string& kind) const;

private:
    std::filesystem::path folder_;
    std::optional<Underlay> underlay_;
    PictureOrder order_;
    std::optional<MomentNames> names_;
    TemporaryFolder data_;
    int frames_ = 0;
};

} // namespace listric
