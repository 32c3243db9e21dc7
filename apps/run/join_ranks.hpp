#pragma once

#include "dem/ranks.hpp"

#include <memory>

namespace listric {

/// What mpirun or srun says of this process, in its environment.
struct Launch {
    int count = 1; ///< processes that were started together
    int mine = 0;  ///< number of this one
};

Launch read_launch();

/// Joins the processes that were started together: loads the plug-in, which starts MPI. Throws
/// UsageError if there is no plug-in, or MPI does not know of the others.
std::unique_ptr<dem::Ranks> join_ranks(const Launch& launch);

} // namespace listric
