#pragma once

#include <filesystem>

namespace listric {

/// Cores that this process can keep busy: those that it may run on, but no more than its control
/// group and those above grant (docker --cpus, SLURM), a part of one counted whole. At least 1.
int usable_cores();

} // namespace listric
