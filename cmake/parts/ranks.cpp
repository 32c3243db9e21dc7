#include <mpi.h>
#include <petscsys.h>

int version() { return MPI_VERSION + PETSC_VERSION_MAJOR; }
