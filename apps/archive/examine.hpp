#pragma once

#include "apps/measures/fault_history.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/named_numbers.hpp"

#include <filesystem>
#include <span>
#include <utility>
#include <vector>

namespace listric {

/// The faults of a state, with the earlier states read from snapshots (oldest first; those that are
/// not older or cannot be read are passed over).
measures::FaultReport report_faults(const Scene& scene, const dem::RigidBase& base,
                                    const dem::State& now,
                                    std::span<const std::filesystem::path> snapshots);

/// All measures of a finished run at the given extensions (m; the snapshots nearest to them),
/// recomputed from its snapshots. Throws SceneError, StorageError.
std::vector<std::pair<double, NamedNumbers>> examine_run(const std::filesystem::path& output,
                                                         std::span<const double> extensions);

} // namespace listric
