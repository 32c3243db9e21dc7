#pragma once

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
                         std::span<const std::unique_ptr<Event>> events,
                         const std::filesystem::path& folder);

/// Runs a program without a shell. Returns its exit code, or -1.
int run_program(const std::vector<std::string>& words);

} // namespace listric
