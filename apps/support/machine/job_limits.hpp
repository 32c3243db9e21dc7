#pragma once

#include <filesystem>

// Limits of control groups for a process (docker --cpus and --memory, SLURM), of version 2 and 1:
// the least of its group and those above it; infinity where nothing is limited.

namespace listric {

/// Cores: cpu.max, cpu.cfs_quota_us.
/// @param root  where /proc and /sys are
double granted_cores(const std::filesystem::path& root);

/// Memory, bytes: memory.max, memory.limit_in_bytes.
double granted_memory(const std::filesystem::path& root);

/// Processes and threads together: pids.max.
double granted_tasks(const std::filesystem::path& root);

} // namespace listric
