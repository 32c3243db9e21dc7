#pragma once

#include "apps/measures/fault.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/file.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"
#include "dem/state.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// Draws the pictures of one state into `folder`. Returns an empty string, or why it could not:
/// pictures are worth a warning, not the run.
std::string draw_figures(const Scene& scene, const dem::State& state, const dem::RigidBase& base,
                         std::span<const std::unique_ptr<dem::Event>> events,
                         const measures::FaultReport& faults, const std::filesystem::path& folder);

/// Pictures of several moments of a run: the arrays that the drawing script reads, in a folder that
/// vanishes with this object.
class FigureFrames {
public:
    /// @param folder  where the pictures go
    explicit FigureFrames(const std::filesystem::path& folder);

    void add(const Scene& scene, const dem::State& state, const dem::RigidBase& base,
             std::span<const std::unique_ptr<dem::Event>> events,
             const measures::FaultReport& faults);

    /// @param kind  "sections" of every frame, one "experiment" sheet, an "animation" or
    ///              a "gallery", gallery.png
    /// Throws StorageError if it cannot be drawn.
    void draw(const std::string& kind) const;

private:
    std::filesystem::path folder_;
    TemporaryFolder data_;
    int frames_ = 0;
};

} // namespace listric
