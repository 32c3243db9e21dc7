#pragma once

#include "dem/ranks/ranks.hpp"

#include <memory>

namespace listric {

/// Rank of this process by mpirun or srun, from its environment.
struct Launch {
    int count = 1; ///< processes that were started together
    int mine = 0;  ///< number of this one
};

/// Throws UsageError where that is nothing that they say.
Launch read_launch();

/// Waits for a moment before a message about a call of `run`, unless this process is the first of
/// those that were started together: that one would say the same, and end all.
void let_root_tell(int argc, const char* const* argv);

/// Joins the processes that were started together: loads the plug-in, which starts MPI. Throws
/// UsageError if there is no plug-in, or MPI does not know of the others.
std::unique_ptr<dem::Ranks> join_ranks(const Launch& launch);

} // namespace listric
