#include "apps/laboratory/envelope.hpp"

#include "apps/support/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace listric {

fem::CoulombLine fit_envelope(const std::vector<double>& confining,
                              const std::vector<double>& axial) {
    const double slope = least_squares_slope(confining, axial);
    const auto n = static_cast<double>(axial.size());
    const double intercept = (std::accumulate(axial.begin(), axial.end(), 0.0) -
                              slope * std::accumulate(confining.begin(), confining.end(), 0.0)) /
                             n;
    const double root = std::sqrt(std::max(slope, 1e-12)); // tan(45 deg + phi / 2)
    return {0.5 * (root - 1.0 / root), intercept / (2.0 * root)};
}

} // namespace listric
