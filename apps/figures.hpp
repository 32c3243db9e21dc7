#pragma once

#include "apps/fault.hpp"
#include "apps/scene.hpp"
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
std::string draw_figures(const Scene& scene, const State& state, const RigidBase& base,
                         std::span<const std::unique_ptr<Event>> events, const FaultReport& faults,
                         const std::filesystem::path& folder);

/// A folder for the arrays that a drawing script reads, which vanishes with this object.
struct TemporaryFolder {
    /// Throws StorageError if none can be made there.
    explicit TemporaryFolder(const std::filesystem::path& where);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path path;
};

/// Pictures of several moments of a run: the arrays that the drawing script reads, in a folder that
/// vanishes with this object.
class FigureFrames {
public:
    /// @param folder  where the pictures go
    explicit FigureFrames(const std::filesystem::path& folder);

    void add(const Scene& scene, const State& state, const RigidBase& base,
             std::span<const std::unique_ptr<Event>> events, const FaultReport& faults);

    /// @param kind  "sections" of every frame, one "experiment" sheet, an "animation" or
    ///              a "gallery", gallery.png
    /// Throws StorageError if it cannot be drawn.
    void draw(const std::string& kind) const;

private:
    std::filesystem::path folder_;
    TemporaryFolder data_;
    int frames_ = 0;
};

/// Runs one of the program's Python scripts. Returns an empty string, or why it could not.
std::string run_drawing_script(const std::string& script,
                               const std::vector<std::string>& arguments);

} // namespace listric
