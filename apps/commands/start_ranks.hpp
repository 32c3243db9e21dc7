#pragma once

#include "apps/run/exit_code.hpp"

#include <filesystem>

namespace listric {

/// Makes this process' call in as many others, which mpirun starts, and waits for their end. What
/// asks this one to stop asks the run to, which saves first: mpirun itself would end its processes
/// within a second, and with a code of its own. If this process is killed, they are asked to stop.
/// Throws UsageError if there is no mpirun, and says what has ended processes that were killed.
/// @param output  of the run
/// @return how they have ended
ExitCode start_ranks(int count, const std::filesystem::path& output);

} // namespace listric
