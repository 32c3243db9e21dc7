#pragma once

#include "apps/measures/fault.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/figure_layer.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"
#include "dem/state.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// What pictures show of one moment. What is referred to must outlive the call.
struct FrameContent {
    const Scene& scene;
    const dem::State& state;
    const dem::RigidBase& base;
    std::span<const std::unique_ptr<dem::Event>> events;
    const FaultReport& faults;
    std::vector<std::string> effects;                    ///< names of those that are on
    std::vector<FigureLayer> layers;                     ///< of the effects
    std::vector<std::pair<std::string, double>> numbers; ///< of the effects, for frame.json
};

/// Writes the arrays of one moment, which apps/figures/python/frame.py describes, and frame.json
/// into a folder of their own. Throws StorageError.
void write_frame(const FrameContent& content, const std::filesystem::path& folder);

} // namespace listric
