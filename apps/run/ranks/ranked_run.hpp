#pragma once

#include "apps/run/options.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "dem/ranks/ranks.hpp"

#include <functional>
#include <optional>
#include <string>

namespace listric {

/// Why several processes cannot make a scene, if so.
std::optional<Objection> objection_to_ranks(const Scene& scene);

/// A run that several processes make together.
struct RankedRun {
    std::function<Scene()> read_scene; ///< by every process
    /// By every process; on the root it throws what refuses the scene.
    std::function<RunOptions(const Scene&, bool is_root)> prepare;
};

/// Makes this process's part of it: the root's is run_scene(), the others make cycles of their
/// shares. What is thrown in one of them is told once and ends all, with its exit code.
RunOutcome run_on_ranks(dem::Ranks& ranks, const RankedRun& run);

} // namespace listric
