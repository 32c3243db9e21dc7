#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>

namespace listric::dem {

/// Throws what MPI says of an error.
inline void require(int error, const char* what) {
    if (error == MPI_SUCCESS)
        return;
    char text[MPI_MAX_ERROR_STRING];
    int length = 0;
    MPI_Error_string(error, text, &length);
    throw std::runtime_error(std::string(what) + ": " + std::string(text, text + length));
}

} // namespace listric::dem
