#pragma once

#include "fem/byerlee.hpp"

#include <vector>

namespace listric {

/// Mohr-Coulomb line fitted to axial strength over confining stress, Pa, least squares.
fem::CoulombLine fit_envelope(const std::vector<double>& confining,
                              const std::vector<double>& axial);

} // namespace listric
