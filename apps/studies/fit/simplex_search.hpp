#pragma once

#include <functional>
#include <span>
#include <vector>

namespace listric {

/// Place at which a function is least, and its value there.
struct SimplexMinimum {
    std::vector<double> at;
    double value = 0.0;
};

/// The least value that the downhill simplex method meets (Nelder and Mead 1965), within
/// [lower, upper]: a place beyond is moved to the nearest one within. No step is random.
/// @param step  edges of the first simplex; a parameter whose step is 0 stays
SimplexMinimum simplex_minimum(const std::function<double(std::span<const double>)>& function,
                               std::span<const double> start, std::span<const double> step,
                               std::span<const double> lower, std::span<const double> upper,
                               int evaluations);

} // namespace listric
