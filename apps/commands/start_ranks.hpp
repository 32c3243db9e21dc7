#pragma once

#include "apps/run/exit_code.hpp"

namespace listric {

/// Makes this process' call in as many others, which mpirun starts, and waits for their end. What
/// asks this one to stop asks the run to, which saves first: mpirun itself would end its processes
/// within a second, and with a code of its own. Throws UsageError if there is no mpirun.
/// @return how they have ended; where mpirun has ended them, its own code
ExitCode start_ranks(int count);

} // namespace listric
