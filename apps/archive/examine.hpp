#pragma once

#include "apps/archive/folder/run_history.hpp"
#include "apps/measures/faults/fault.hpp"
#include "apps/measures/setting.hpp"
#include "apps/support/named_numbers.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <filesystem>
#include <span>
#include <utility>
#include <vector>

namespace listric::archive {

/// The faults of a state, with the earlier moments of its run.
measures::FaultReport report_faults(const measures::Setting& setting, const dem::RigidBase& base,
                                    const dem::State& now, const RunHistory& history);

/// Faults without their past, in a tenth of the time: places of the lines and present slip.
measures::FaultReport active_faults(const measures::Setting& setting, const dem::RigidBase& base,
                                    const dem::State& now, const RunHistory& history);

/// All measures of a finished run at the given extensions (m; of the nearest snapshots, at most a
/// window of output away), recomputed from its snapshots. Throws SceneError, StorageError.
std::vector<std::pair<double, NamedNumbers>> examine_run(const std::filesystem::path& output,
                                                         std::span<const double> extensions);

} // namespace listric::archive
