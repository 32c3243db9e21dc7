#pragma once

#include <filesystem>

namespace listric {

/// Cores that this process can keep busy: those that it may run on, but no more than its control
/// group and those above grant (docker --cpus, SLURM), a part of one counted whole. At least 1.
int usable_cores();

/// Cores that control groups grant to a process, or infinity. Of version 2 (cpu.max) and 1
/// (cpu.cfs_quota_us).
/// @param root  where /proc and /sys are
double granted_cores(const std::filesystem::path& root);

} // namespace listric
