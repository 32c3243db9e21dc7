#pragma once

#include "dem/ranks.hpp"

#include <memory>

namespace listric::dem {

/// The processes that mpirun or srun has started. Starts MPI and PETSc, which end with it.
std::unique_ptr<Ranks> make_mpi_ranks();

} // namespace listric::dem
