#include <deal.II/base/config.h>

#include <mpi.h>
#include <p4est.h>
#include <petscksp.h>

int version() { return MPI_VERSION + PETSC_VERSION_MAJOR + DEAL_II_VERSION_MAJOR; }
