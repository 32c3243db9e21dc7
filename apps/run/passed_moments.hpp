#pragma once

#include "apps/archive/run_history.hpp"
#include "apps/scene/effect.hpp"
#include "apps/support/moment_names.hpp"

#include <filesystem>
#include <future>
#include <string>
#include <vector>

namespace listric {

// What a run has left of the moments before its present one, in its folder.

/// Snapshots at the ends of windows up to an extension, m, oldest first.
std::vector<std::filesystem::path> ended_windows(const std::filesystem::path& output,
                                                 const MomentNames& names, double extension);

/// Removes what was written where the run was stopped before an extension, m, from which it has
/// gone on: it is then as if it had never stopped.
void remove_passed_stops(const std::filesystem::path& output, const MomentNames& names,
                         double extension);

/// Draws those pictures of ended windows that a killed session has not come to. Each says what is
/// wrong.
std::vector<std::future<std::string>> draw_missing(const std::filesystem::path& output,
                                                   const Scene& scene, const MomentNames& names,
                                                   const std::vector<std::filesystem::path>& ended,
                                                   const archive::RunHistory& history);

} // namespace listric
